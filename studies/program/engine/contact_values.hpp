#pragma once

#include "reduction/reduced_model.hpp"
#include "studies/program/engine/node_lists.hpp"
#include "studies/program/study_file/section_reader.hpp"

// What the documents of reduced models and of structures have in common.
namespace dovetail::studies {

/// The key `version` of a document: 1.
void read_version(SectionReader& root, Problems& problems);

/// The value of a key that must be there, or null.
[[nodiscard]] const Node* required(SectionReader& section, Problems& problems, const std::string& key,
                                   const char* what);

/// What the `count` contact nodes of a section [contact] are like: area, gap, friction, wear, slip_origin, position,
/// group. `contact.tangential` has its columns already.
void read_contact_values(SectionReader& section, Lists& lists, Problems& problems, reduction::ContactNodes& contact,
                         Eigen::Index count);

}  // namespace dovetail::studies
