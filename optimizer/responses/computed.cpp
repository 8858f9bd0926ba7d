#include "optimizer/responses/computed.hpp"

#include <utility>

#include "optimizer/responses/response_table.hpp"

namespace dovetail::optimizer {

CandidateResult computed(const Scene& scene, CandidateModel model, const Computation& how) {
  CandidateResult result = through_stages(scene, std::move(model), how);
  for (const Response& response : responses())
    if (result.stage && response.stage <= *result.stage)
      result.evaluation.responses[std::string(response.name)] = response.value(scene, result);
  return result;
}

}  // namespace dovetail::optimizer
