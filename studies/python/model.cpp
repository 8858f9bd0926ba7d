#include "studies/python/model.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <string>

#include "reduction/model_file.hpp"
#include "studies/program/engine/loaded_model.hpp"
#include "studies/program/study_file/refusal.hpp"

namespace dovetail::python {

namespace py = pybind11;
using reduction::ContactNodes;
using reduction::ReducedModel;

namespace {

/// A member that is an array: shown without a copy, and kept alive by what shows it. It can be written to, entry by
/// entry; its shape stays.
template <class Class, class Object, class Array>
void bind_array(Class& binding, const char* name, Array Object::*member, const char* words) {
  binding.def_property_readonly(
      name, [member](Object& self) -> Array& { return self.*member; }, py::return_value_policy::reference_internal,
      words);
}

void bind_contact(py::module_& module) {
  py::class_<ContactNodes> contact(module, "Contact", R"(The Nc contact nodes of a reduced model.

Arrays are views of the model, not copies: writing to them changes it.)");
  bind_array(contact, "normal", &ContactNodes::normal,
             "int32 [Nc]: the coordinate that is u_N of each node, closing positive.");
  bind_array(contact, "tangential", &ContactNodes::tangential,
             "int32 [Nc, d-1]: the coordinates of its one or two tangential displacements.");
  bind_array(contact, "area", &ContactNodes::area, "float64 [Nc], m^2.");
  bind_array(contact, "gap", &ContactNodes::gap, "float64 [Nc], m: the initial gap; negative: interference.");
  bind_array(contact, "friction", &ContactNodes::friction, "float64 [Nc]: the coefficient of friction.");
  bind_array(contact, "wear_coefficient", &ContactNodes::wear_coefficient,
             "float64 [Nc], 1/Pa of Archard's law, m^3/J of the law \"energy\".");
  bind_array(contact, "wear_threshold", &ContactNodes::wear_threshold,
             "float64 [Nc] or empty, J/m^2 per cycle, of the law \"energy\".");
  bind_array(contact, "position", &ContactNodes::position, "float64 [Nc, 3] or empty, m.");
  bind_array(contact, "group", &ContactNodes::group, "int32 [Nc] or empty: the flank of each node.");
  bind_array(contact, "slip_origin", &ContactNodes::slip_origin,
             "float64 [Nc, d-1], m: the slip at which the periodic march starts.");
  contact.def_readwrite("wear_law", &ContactNodes::wear_law, "\"archard\" or \"energy\".");
  contact.def("__len__", [](const ContactNodes& self) { return self.count(); });
}

}  // namespace

void bind_model(py::module_& module) {
  bind_contact(module);
  py::class_<ReducedModel, Model> model(module, "Model",
                                        R"(A reduced model, M q'' + C q' + K q + lambda = f(t), of n coordinates.

It comes from Study.reduce() or Model.read(). Arrays are views, not copies: writing to them changes the model, and they
keep it alive. Everything is checked before it is computed with or written.)");
  bind_array(model, "mass", &ReducedModel::mass, "float64 [n, n], kg, symmetric.");
  bind_array(model, "damping", &ReducedModel::damping, "float64 [n, n], N s/m, symmetric.");
  bind_array(model, "stiffness", &ReducedModel::stiffness, "float64 [n, n], N/m, symmetric.");
  bind_array(model, "static_force", &ReducedModel::static_force, "float64 [n], N.");
  bind_array(model, "cosine_force", &ReducedModel::cosine_force, "float64 [H, n], N: row j-1 is harmonic j.");
  bind_array(model, "sine_force", &ReducedModel::sine_force, "float64 [H, n], N: row j-1 is harmonic j.");
  bind_array(model, "output_vectors", &ReducedModel::output_vectors, "float64 [n_out, n]: outputs y = c^T q.");
  model
      .def_property_readonly(
          "output_names", [](const ReducedModel& self) { return self.output_names; },
          "list[str], of the n_out outputs.")
      .def_property_readonly(
          "contact", [](ReducedModel& self) -> ContactNodes& { return self.contact; },
          py::return_value_policy::reference_internal, "The contact nodes.")
      .def("__len__", &ReducedModel::size)
      .def("__repr__",
           [](const ReducedModel& self) {
             return "<dovetail.Model of " + std::to_string(self.size()) + " coordinates, " +
                    std::to_string(self.contact.count()) + " contact nodes>";
           })
      .def_static(
          "read",
          [](const py::object& path) {
            const std::string file = py::str(path).cast<std::string>();
            std::optional<ReducedModel> read = studies::read_any_model(file);
            if (!read) studies::refuse(file, "is not a reduced model");
            return std::make_shared<ReducedModel>(std::move(*read));
          },
          py::arg("path"),
          "read(path)\n--\n\nReads a reduced model file: HDF5, or TOML with matrices beside it. Raises InputError.")
      .def(
          "write",
          [](const ReducedModel& self, const py::object& path) {
            reduction::write_model(py::str(path).cast<std::string>(), self);
          },
          py::arg("path"), "write(self, path)\n--\n\nWrites the reduced model file (HDF5). Raises InputError.");
}

}  // namespace dovetail::python
