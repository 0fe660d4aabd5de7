"""Feeds layering.py small trees with one forbidden thing each, and one without."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("layering.py")

CLEAN = {
    "src/core/error.h": "#include <string>\n",
    "src/model/model.h": '#include "core/error.h"\n#include <Eigen/Core>\n',
    "src/stepping/stepper.h": '#include "model/model.h"\n',
    "src/ode/world.cpp": '#include "model/model.h"\n#include <ode/ode.h>\ndouble f(double x) { return std::expm1(x); }\n',
    "src/solver/joints/rows.h": '#include "model/model.h"\n',
    "src/solver/contacts/rows.h": '#include "model/model.h"\n',
    "src/solver/worlds/sor.h": '#include "solver/joints/rows.h"\n#include "stepping/stepper.h"\n',
    "src/estimate/feec.h": '#include "stepping/stepper.h"\n',
    "src/analysis/defect.h": '#include "model/model.h"\n',
    "scenes/scene.h": '#include "model/model.h"\n',
    "mpi/comm/check.h": "#include <mpi.h>\n",
    "mpi/worlds/driver.h": '#include "mpi/comm/check.h"\n',
    "io/hdf5/open.cpp": "#include <hdf5.h>\n#include <mpi.h>\n",
    "io/run/file.h": '#include "model/model.h"\n',
    "src/app/pbmpi/main.cpp":
        '#include <boost/program_options.hpp>\n#include "scenes/scene.h"\n#include "mpi/worlds/driver.h"\n',
}

FORBIDDEN = {
    "core_sees_model": ("src/core/bad.h", '#include "model/model.h"\n'),
    "model_sees_scenes": ("src/model/bad.h", '#include "scenes/scene.h"\n'),
    "model_sees_stepping": ("src/model/bad.h", '#include "stepping/stepper.h"\n'),
    "ode_sees_solver": ("src/ode/bad.cpp", '#include "solver/worlds/sor.h"\n'),
    "solver_sees_ode": ("src/solver/worlds/bad.cpp", '#include "ode/world.cpp"\n'),
    "solver_sees_the_engine": ("src/solver/pack/bad.cpp", "  #  include <ode/ode.h>\n"),
    "solver_sees_bullet": ("src/solver/pack/bad.cpp", "#include <btBulletDynamicsCommon.h>\n"),
    "bullet_sees_ode": ("src/bullet/bad.cpp", '#include "ode/world.cpp"\n'),
    "engines_see_mujoco_itself": ("src/engines/bad.cpp", "#include <mujoco/mujoco.h>\n"),
    "joints_see_contacts": ("src/solver/joints/bad.h", '#include "solver/contacts/rows.h"\n'),
    "joints_see_worlds": ("src/solver/joints/bad.h", '#include "solver/worlds/sor.h"\n'),
    "model_sees_the_engine": ("src/model/bad.cpp", '#include "ode/ode.h"\n'),
    "analysis_sees_solver": ("src/analysis/bad.cpp", '#include "solver/worlds/sor.h"\n'),
    "mpi_sees_io": ("mpi/frame/bad.cpp", '#include "io/run/file.h"\n'),
    "io_sees_mpi_folder": ("io/run/bad.cpp", '#include "mpi/worlds/driver.h"\n'),
    "scenes_sees_app": ("scenes/bad.cpp", '#include "../src/app/pbmpi/main.cpp"\n'),
    "second_file_of_io_sees_mpi": ("io/hdf5/bad.cpp", "#include <mpi.h>\n"),
    "app_sees_mpi_header": ("src/app/pbmpi/bad.cpp", "#include <mpi.h>\n"),
    "mpi_sees_hdf5": ("mpi/comm/bad.cpp", "#include <hdf5.h>\n"),
    "scenes_sees_boost": ("scenes/bad.cpp", "#include <boost/any.hpp>\n"),
    "file_outside_the_folders": ("src/other/bad.cpp", "#include <string>\n"),
    "geometry_calls_hypot": ("src/geometry/bad.cpp", "double f(double x) { return std::hypot(x, 1); }\n"),
    "a_part_of_the_solver_calls_sin": ("src/solver/joints/bad.h", "inline double f(double x) { return std::sin(x); }\n"),
}


def check(files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)


class Layering(unittest.TestCase):
    def test_accepts_every_arrow(self):
        result = check(CLEAN)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{len(CLEAN)} files, 0 forbidden", result.stdout)

    def test_refuses_each_forbidden_thing(self):
        for name, (path, text) in FORBIDDEN.items():
            with self.subTest(name):
                result = check(CLEAN | {path: text})
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn(path, result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def test_refuses_a_folder_of_too_many_files(self):
        result = check(CLEAN | {f"src/core/part{i}.h": "\n" for i in range(25)})
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn("src/core: 26 files", result.stderr)

    def test_refuses_a_folder_without_sources(self):
        self.assertNotEqual(check({"README.md": "nothing\n"}).returncode, 0)


if __name__ == "__main__":
    unittest.main()
