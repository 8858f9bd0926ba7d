#include "optimizer/search/ipopt_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>

// IpTNLP.hpp of 3.11 leaves arguments of its defaults unnamed in meaning but not in name.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>

#include "optimizer/search/params.hpp"
#pragma GCC diagnostic pop

namespace dovetail::optimizer {

namespace {

using Ipopt::Index;
using Ipopt::Number;

class Program : public Ipopt::TNLP {
 public:
  Program(SearchFunctions& functions, std::vector<double> start) : functions_(functions), start_(std::move(start)) {}

  [[nodiscard]] const CallbackGuard& guard() const { return guard_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = static_cast<Index>(functions_.size());
    m = static_cast<Index>(functions_.constraint_count());
    jacobian = n * m;
    hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* c_lower, Number* c_upper) override {
    std::fill_n(lower, n, 0.0);
    std::fill_n(upper, n, 1.0);
    std::fill_n(c_lower, m, -1e20);  // beyond Ipopt's infinity of 1e19
    std::fill_n(c_upper, m, 0.0);
    return true;
  }

  bool get_starting_point(Index, bool, Number* u, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(start_.begin(), start_.end(), u);
    return true;
  }

  bool eval_f(Index n, const Number* u, bool, Number& objective) override {
    return value(n, u, [&](const SearchValue& seen) { objective = seen.objective; });
  }

  bool eval_g(Index n, const Number* u, bool, Index, Number* c) override {
    return value(n, u,
                 [&](const SearchValue& seen) { std::copy(seen.constraints.begin(), seen.constraints.end(), c); });
  }

  bool eval_grad_f(Index n, const Number* u, bool, Number* gradient) override {
    return guard_.run([&] {
      const SearchGradient g = functions_.gradient({u, static_cast<std::size_t>(n)});
      std::copy(g.objective.begin(), g.objective.end(), gradient);
    });
  }

  bool eval_jac_g(Index n, const Number* u, bool, Index m, Index, Index* row, Index* column, Number* values) override {
    if (values == nullptr) {
      for (Index j = 0; j < m; ++j) {
        for (Index i = 0; i < n; ++i) {
          row[j * n + i] = j;
          column[j * n + i] = i;
        }
      }
      return true;
    }
    return guard_.run([&] {
      const SearchGradient g = functions_.gradient({u, static_cast<std::size_t>(n)});
      for (const std::vector<double>& c : g.constraints) values = std::copy(c.begin(), c.end(), values);
    });
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number, Number,
                             Number, Index, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    return !guard_.failed();
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*, Index, const Number*,
                         const Number*, Number, const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  template <class Take>
  bool value(Index n, const Number* u, Take&& take) {
    bool computed = false;
    const bool well = guard_.run([&] {
      const SearchValue seen = functions_.value({u, static_cast<std::size_t>(n)});
      computed = seen.computed;
      take(seen);
    });
    return well && computed;
  }

  SearchFunctions& functions_;
  std::vector<double> start_;
  CallbackGuard guard_;
};

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

SearchOutcome ipopt_search(SearchFunctions& functions, const std::vector<double>& start) {
  if (!functions.value(start).computed)
    return {.status = Status::stalled,
            .message = "ipopt: the start could not be computed; give another or let a scan find one"};
  const std::lock_guard lock(one_at_a_time());
  const OptimizerOptions& options = functions.options();
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  application->RethrowNonIpoptException(true);
  Ipopt::OptionsList& list = *application->Options();
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("sb", "yes");
  list.SetStringValue("hessian_approximation", "limited-memory");
  list.SetStringValue("nlp_scaling_method", "none");  // objective and constraints arrive scaled
  list.SetNumericValue("bound_relax_factor", 0.0);    // a design just outside its bounds may not exist
  constexpr LibraryParams kParams;
  // Differences of noisy responses cannot show a smaller slope than this.
  const double slope =
      std::max(options.tolerance, 2 * std::max(options.noise, kParams.least_noise) / difference_step(options));
  list.SetNumericValue("tol", slope);
  list.SetNumericValue("acceptable_tol", kParams.acceptable * slope);
  list.SetIntegerValue("acceptable_iter", kParams.acceptable_iterations);
  list.SetNumericValue("acceptable_obj_change_tol", std::max(options.tolerance, options.noise));
  const double violation = std::max(options.constraint_margin / 2, kParams.constraint_tolerance);
  list.SetNumericValue("constr_viol_tol", violation);
  list.SetNumericValue("acceptable_constr_viol_tol", violation);
  list.SetIntegerValue("max_iter", kParams.iterations);

  Ipopt::SmartPtr<Program> program = new Program(functions, start);
  Ipopt::ApplicationReturnStatus status = application->Initialize("");
  if (status == Ipopt::Solve_Succeeded)
    status = application->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(program)));
  program->guard().rethrow();
  switch (status) {
    case Ipopt::Solve_Succeeded:
    case Ipopt::Solved_To_Acceptable_Level:
      return {.status = Status::converged, .message = "ipopt: stopping rule reached"};
    case Ipopt::Maximum_Iterations_Exceeded:
      return {.status = Status::iteration_limit, .message = "ipopt: iteration limit"};
    case Ipopt::Infeasible_Problem_Detected:
      return {.status = Status::stalled, .message = "ipopt: found no candidate that meets the constraints"};
    case Ipopt::Search_Direction_Becomes_Too_Small:
    case Ipopt::Restoration_Failed:
      return {.status = Status::stalled, .message = "ipopt: no further step improves"};
    default:
      return {.status = Status::stalled,
              .message = "ipopt: ended with status " + std::to_string(static_cast<int>(status))};
  }
}

}  // namespace dovetail::optimizer
