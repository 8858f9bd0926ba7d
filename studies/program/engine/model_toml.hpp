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

/// Whether the document says it is one: its key `format` is "dovetail-reduced-model", or kStructureFormat.
[[nodiscard]] bool is_model_document(const Document& document);

/// Reads the model and the matrices it names, or reduces the structure. Throws InputError with all that is wrong.
[[nodiscard]] reduction::ReducedModel read_model_document(const Document& document);

/// A structure with the matrices of another finite-element code, not reduced (see reduction::read_structure for files):
///
///     format = "dovetail-structure"
///     version = 1
///     stiffness = "joint.sti"         # names relative to this file
///     mass = "joint.mas"              # left out: quasi-static
///     dofs = "joint.dof"              # where the matrices do not name their degrees of freedom
///     units = "mm, t, s"              # of the matrices; everything here is SI
///
///     [reduction]
///     modes = 20
///     damping_ratio = 0.001
///
///     [contact]
///     nodes = [11, 12]                # of the one body
///     against = [21, 22]              # of the other, in the same places; left out, or 0: rigid ground
///     normal = [0, 1]                 # out of the one body into the other, of all pairs or a list; in space three
///     area = 1e-6                     # and gap, friction, wear_coefficient, ... as of a reduced model
///
///     [[force]]
///     node = 5
///     direction = 1
///     harmonic = 1
///     cosine = 0.3                    # or file = "cload.inp", whose values cosine and sine multiply
///
///     [[output]]
///     name = "tip"
///     node = 5
///     direction = 1
inline constexpr const char* kStructureFormat = "dovetail-structure";

/// The structure, reduced. Throws InputError with all that is wrong, and for one that nothing holds.
[[nodiscard]] reduction::ReducedModel read_structure_document(const Document& document);

/// Writes FILE.toml and beside it FILE.mass.mtx, FILE.damping.mtx, FILE.stiffness.mtx; the same model is read back to
/// the last bit. `origin` says in a comment where it comes from. Throws InputError for an invalid model, a name that
/// does not end with .toml or files that cannot be written.
void write_model_document(const std::string& file, const reduction::ReducedModel& model, const std::string& origin);

}  // namespace dovetail::studies
