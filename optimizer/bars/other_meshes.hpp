#pragma once

#include <optional>
#include <vector>

#include "optimizer/candidate/candidate_model.hpp"

namespace dovetail::optimizer {

/// The design's scene on another mesh: all sizes that the kind of the scene lets another mesh change `ratio` times as
/// large.
[[nodiscard]] Scene resized(Scene scene, double ratio);

/// The same with another ratio beside the flanks, where the kind lets these have sizes of their own.
[[nodiscard]] Scene resized(Scene scene, double ratio, double beside);

/// The design on a mesh whose elements in the section, but for those along the flanks, are `ratio` times as large.
[[nodiscard]] Scene resized_section(Scene scene, double ratio);

/// The design on a mesh that has the same section and few elements along the slot.
[[nodiscard]] Scene with_few_layers(Scene scene);

/// Makes the models of a study's designs on the other meshes that error bars are asked of.
class OtherMeshes {
 public:
  struct Mesh {
    double ratio;  ///< of the sizes of its elements to those of the design's own
    ModelBuilder builder;
  };

  /// `finer`: one of them is, whatever the mesh of the reference, where the kind of scene asks finer ones at all.
  explicit OtherMeshes(const Scene& reference, bool finer = false);
  /// Where meshes of the kind are fine, coarser ones alone unless a finer one was asked for; in the order in which the
  /// error by the mesh is asked for.
  [[nodiscard]] const std::vector<Mesh>& meshes() const { return meshes_; }
  /// A finer section and the design's own, both on few layers; no own one where the design has no more of them.
  struct Sections {
    std::optional<ModelBuilder> own;
    ModelBuilder finer;
  };
  /// Where those meshes do not resize the section beside the flanks; else null.
  [[nodiscard]] const Sections* sections() const { return sections_ ? &*sections_ : nullptr; }

 private:
  std::vector<Mesh> meshes_;
  std::optional<Sections> sections_;
};

}  // namespace dovetail::optimizer
