/// The extension `_pbmpi` of the package `pbmpi`: what its Python parts build on.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/python/python_batch.h"

namespace pbmpi::python {
namespace {

namespace py = pybind11;
using namespace pybind11::literals;

std::unique_ptr<PythonBatch> make_batch(const std::string& scene, const std::string& scene_text,
                                        int num_worlds, std::uint64_t seed,
                                        const std::map<std::string, std::string>& settings,
                                        const std::vector<Parameters>& parameters,
                                        std::optional<int> communicator) {
  const BatchOptions options{scene, scene_text, num_worlds, seed, settings, parameters, communicator};
  const py::gil_scoped_release without_interpreter;
  return std::make_unique<PythonBatch>(options);
}

void add_motor(py::module_& module) {
  py::class_<Motor>(module, "Motor", "An axis that a motor drives.")
      .def_readonly("name", &Motor::name, "The joint's, with \"/2\" behind it for a second axis.")
      .def_readonly("max_force", &Motor::max_force, "[N m], of a slider [N]: at the start.")
      .def_readonly("hold_rate", &Motor::hold_rate,
                    "[1/s] at which it returns to its target, at the start; 0: it holds no pose.")
      .def("__repr__", [](const Motor& motor) {
        return "Motor(name=" + py::repr(py::str(motor.name)).cast<std::string>() +
               ", max_force=" + py::repr(py::float_(motor.max_force)).cast<std::string>() + ")";
      });
}

template <std::vector<double> BatchState::*member>
py::array_t<double> view_of(const py::object& self) {
  return PythonBatch::view(self, member);
}

template <std::vector<double> BatchJoints::*member>
py::array_t<double> joint_view_of(const py::object& self) {
  return PythonBatch::joint_view(self, member);
}

void add_sizes(py::class_<PythonBatch>& batch) {
  batch
      .def_property_readonly(
          "num_worlds", [](const PythonBatch& of) { return of.batch().num_worlds(); }, "Worlds of all ranks.")
      .def_property_readonly(
          "num_local_worlds", [](const PythonBatch& of) { return of.batch().num_local_worlds(); },
          "Worlds of this rank: the length of the first dimension of its arrays.")
      .def_property_readonly(
          "world_ids",
          [](const PythonBatch& of) {
            const auto ids = of.batch().world_ids();
            return py::array_t<int>(std::ssize(ids), ids.data());
          },
          "[worlds] numbers of this rank's worlds, ascending.")
      .def_property_readonly(
          "num_bodies", [](const PythonBatch& of) { return of.batch().num_bodies(); },
          "Bodies of a world; all have the same.")
      .def_property_readonly(
          "body_names",
          [](const PythonBatch& of) {
            const auto names = of.batch().body_names();
            return std::vector<std::string>(names.begin(), names.end());
          },
          "[bodies] names, e.g. \"car.chassis\".")
      .def_property_readonly(
          "dt", [](const PythonBatch& of) { return of.batch().dt_s(); }, "Length of a step [s].")
      .def_property_readonly(
          "steps_per_frame", [](const PythonBatch& of) { return of.batch().steps_per_frame(); },
          "Steps of a frame, as the scene has it.")
      .def_property_readonly(
          "motors",
          [](const PythonBatch& of) {
            const auto motors = of.batch().motors();
            return std::vector<Motor>(motors.begin(), motors.end());
          },
          "[motors] axes that motors drive; the same in all worlds.")
      .def_property_readonly(
          "joint_names",
          [](const PythonBatch& of) {
            std::vector<std::string> names;
            for (const JointAxis& axis : of.batch().joint_axes()) names.push_back(axis.name);
            return names;
          },
          "[axes] names of joint axes: the joint's, with \"/2\" behind it for a second axis. Ball and fixed "
          "joints\n"
          "have none. The same in all worlds.")
      .def_property_readonly(
          "observable_names", [](const PythonBatch& of) { return of.batch().observable_names(); },
          "What observable() knows: the columns of /observables/world in io/SCHEMA.md.");
}

void add_state(py::class_<PythonBatch>& batch) {
  batch
      .def_property_readonly(
          "position", view_of<&BatchState::position>,
          "[worlds][bodies][3] m: centres of mass, world frame, z up. A read-only view, see Batch.")
      .def_property_readonly("orientation", view_of<&BatchState::orientation>,
                             "[worlds][bodies][4] (w, x, y, z). A read-only view, see Batch.")
      .def_property_readonly("velocity", view_of<&BatchState::velocity>,
                             "[worlds][bodies][3] m/s, world frame. A read-only view, see Batch.")
      .def_property_readonly("angular_velocity", view_of<&BatchState::angular_velocity>,
                             "[worlds][bodies][3] rad/s, world frame. A read-only view, see Batch.")
      .def_property_readonly(
          "joint_position", joint_view_of<&BatchJoints::position>,
          "[worlds][axes] rad, within half a turn, or of a slider m: how far each joint's first body has "
          "turned "
          "or\n"
          "moved against the second since the world's first step. A read-only view, see Batch.")
      .def_property_readonly("joint_velocity", joint_view_of<&BatchJoints::velocity>,
                             "[worlds][axes] rad/s, of a slider m/s. A read-only view, see Batch.")
      .def("set_state", &PythonBatch::set_state, "position"_a = py::none(), "orientation"_a = py::none(),
           "velocity"_a = py::none(), "angular_velocity"_a = py::none(), py::kw_only(), "mask"_a = py::none(),
           "Replaces poses and velocities, shaped as the properties are; None: stays as it is. Forces that a "
           "step\n"
           "hands on to the next, and what sleeps or is broken, stay, as in a world that somebody pushed.\n\n"
           "mask: [worlds] bools, whose; None: of all.\n"
           "ValueError for another shape, TypeError for what holds no numbers.")
      .def("observable", &PythonBatch::observable, "name"_a,
           "[worlds], or [worlds][3] of a vector: what was measured after the last step, a copy. Units stand "
           "in\n"
           "io/SCHEMA.md, /observables/world. ValueError for a name that is not in observable_names.")
      .def_property_readonly("steps", &PythonBatch::steps,
                             "[worlds] int64: steps since each world's start, a copy.");
}

void add_calls(py::class_<PythonBatch>& batch) {
  batch
      .def("step", &PythonBatch::step, "steps"_a = 1,
           "Steps all worlds of this rank; other threads of Python go on meanwhile. No message between "
           "ranks.\n"
           "Ctrl-C ends it between two steps; `steps` then tells how far it came. RuntimeError if the run "
           "fails.")
      .def("_reset", &PythonBatch::reset, "mask"_a, "seed"_a, "parameters"_a)
      .def("set_motor_velocities", &PythonBatch::set_motor_velocities, "velocities"_a,
           "[worlds][motors], or [motors] for all worlds alike: rad/s (of a slider m/s) at which the motors "
           "aim from\n"
           "the next step on; NaN leaves a motor as it is. Holds until the next call, a reset of the world, "
           "or an\n"
           "event of the scene for this motor. ValueError for another shape.")
      .def(
          "set_targets", &PythonBatch::set_targets, "positions"_a,
          "[worlds][motors], or [motors] for all worlds alike: rad (of a slider m), as joint_position has\n"
          "them, to which motors with a hold_rate bring their axes, as position servos of MJCF are: they "
          "aim\n"
          "at hold_rate x (target - position), with at most their force, until the next call of this or of\n"
          "set_motor_velocities. NaN leaves a motor as it is. ValueError for another shape, and for a motor\n"
          "without a hold_rate.")
      .def(
          "set_forces", &PythonBatch::set_forces, "forces"_a = py::none(), "torques"_a = py::none(),
          "[worlds][bodies][3] N on centres of mass, and N m, world frame: they act throughout each step, "
          "from "
          "the\n"
          "next one on, until the next call or a reset of the world; None: none. With the stepper sor only.\n"
          "ValueError for another shape, stepper, or a number that is not finite.")
      .def(
          "set_efforts", &PythonBatch::set_efforts, "efforts"_a,
          "[worlds][axes], or [axes] for all worlds alike: N m about, or of a slider N along, the axes of "
          "joint_names,\n"
          "which turn with their bodies. They act besides motors, likewise; None: none. ValueError likewise.")
      .def("save", &PythonBatch::save,
           "bytes with all that this rank's worlds need to go on, bit for bit, in a batch of the same scene "
           "and\n"
           "settings with as many worlds on this rank.")
      .def("load", &PythonBatch::load, "saved"_a,
           "Goes on from what save() gave. ValueError, and nothing changed, if that is another batch's or "
           "damaged.")
      .def("hash", &PythonBatch::hash, "world"_a = py::none(),
           "16 hexadecimal digits over all bits of one of this rank's worlds, or (collective) of all worlds "
           "of all\n"
           "ranks: what pbmpi prints as state_hash.");
}

}  // namespace
}  // namespace pbmpi::python

PYBIND11_MODULE(_pbmpi, module) {
  namespace py = pybind11;
  using namespace pybind11::literals;
  using pbmpi::python::PythonBatch;
  module.doc() = "What the package pbmpi builds on; not meant to be imported by others.";
  module.def("version", &pbmpi::version, "Version of the library, e.g. \"0.1.0\".");
  pbmpi::python::add_motor(module);
  py::class_<PythonBatch> batch(module, "Batch");
  batch.def(py::init(&pbmpi::python::make_batch), "scene"_a, "scene_text"_a, "num_worlds"_a, "seed"_a,
            "settings"_a, "parameters"_a, "communicator"_a);
  pbmpi::python::add_sizes(batch);
  pbmpi::python::add_state(batch);
  pbmpi::python::add_calls(batch);
}
