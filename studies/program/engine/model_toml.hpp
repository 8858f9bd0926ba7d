#pragma once

#include <string>

#include "reduction/reduced_model.hpp"
#include "studies/program/study_file/document.hpp"

namespace dovetail::studies {

/// A reduced model without HDF5: a TOML file with contact nodes, forces and outputs, and beside it three Matrix Market
/// files with mass, damping and stiffness. Written by hand or by a script:
///
///     format = "dovetail-reduced-model"
///     version = 1
///     mass = "rod.mass.mtx"           # names relative to this file
///     damping = "rod.damping.mtx"
///     stiffness = "rod.stiffness.mtx"
///
///     [contact]                       # one entry per contact node; dofs count from 0
///     normal = [10, 12]
///     tangential = [11, 13]           # in space pairs: [[11, 12], [14, 15]]
///     area = 1e-6                     # m^2; one number is that of all nodes
///     gap = [0.0, -1e-6]
///     friction = 0.5
///     wear_coefficient = 1e-13        # in the unit of wear_law, which is Archard's unless given
///
///     [[force]]
///     dof = 9
///     harmonic = 1                    # 0: static, and then there is no sine
///     cosine = 0.3
///
///     [[output]]
///     name = "tip"
///     dofs = [9]                      # y = sum factors[k] q[dofs[k]]; factors are 1 if left out

/// Whether the document says it is one: its key `format` is "dovetail-reduced-model".
[[nodiscard]] bool is_model_document(const Document& document);

/// Reads the model and the matrices it names. Throws InputError with all that is wrong.
[[nodiscard]] reduction::ReducedModel read_model_document(const Document& document);

/// Writes FILE.toml and beside it FILE.mass.mtx, FILE.damping.mtx, FILE.stiffness.mtx; the same model is read back to
/// the last bit. `origin` says in a comment where it comes from. Throws InputError for an invalid model, a name that
/// does not end with .toml or files that cannot be written.
void write_model_document(const std::string& file, const reduction::ReducedModel& model, const std::string& origin);

}  // namespace dovetail::studies
