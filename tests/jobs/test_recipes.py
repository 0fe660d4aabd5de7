"""Recipes that no test can run: they are well-formed, and follow the build as it is."""
import ast
import pathlib
import re
import subprocess
import types
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = SOURCE / "jobs/packages"
DOCKERFILE = PACKAGES / "containers/Dockerfile"
APPTAINER = PACKAGES / "containers/pbmpi.def"

# Debian's package -> Spack's; None: of the tools that Spack brings or has no use for, or part of the recipe itself.
SPACK = {"g++": "cxx", "cmake": "cmake", "ninja-build": None, "pkg-config": "pkgconfig", "git": None, "ca-certificates": None,
         "openmpi-bin": "mpi", "libopenmpi-dev": "mpi", "openssh-client": None, "libhdf5-openmpi-dev": "hdf5",
         "libode-dev": "open-dynamics-engine", "libeigen3-dev": "eigen", "libfmt-dev": "fmt",
         "libboost-program-options-dev": "boost",
         "libtomlplusplus-dev": "tomlplusplus", "libpugixml-dev": "pugixml", "nlohmann-json3-dev": "nlohmann-json", "libjs-three": None,
         "libjs-chart.js": None, "pybind11-dev": "py-pybind11", "python3-dev": None, "python3-numpy": "py-numpy",
         "python3-h5py": None, "libpython3-dev": None, "python3": None}


def debian_packages():
    """What jobs/install_packages.sh installs without an option."""
    text = (SOURCE / "jobs/install_packages.sh").read_text(encoding="utf-8")
    return re.search(r"^packages=\((.*?)\)", text, re.MULTILINE | re.DOTALL)[1].split()


class SpackRecipe:
    """Runs a package.py with a stand-in for Spack that writes down what the recipe declares."""

    def __init__(self, name):
        path = PACKAGES / "spack/packages" / name / "package.py"
        source = path.read_text(encoding="utf-8")
        tree = ast.parse(source)
        self.calls = []

        class Context:
            def __enter__(self):
                return self

            def __exit__(self, *_):
                return False

        def directive(name):
            return lambda *args, **named: (self.calls.append((name, args, named)), Context())[1]

        names = {name: directive(name) for name in ("version", "variant", "depends_on", "resource", "extends", "license", "when")}
        names |= {"run_before": lambda _: lambda function: function, "CMakePackage": type("CMakePackage", (), {})}
        tree.body = [node for node in tree.body if not (isinstance(node, ast.ImportFrom) and node.module == "spack.package")]
        exec(compile(tree, str(path), "exec"), names)  # the recipe is ours
        self.package = next(value for key, value in names.items()
                            if isinstance(value, type) and value.__module__ == "builtins" and key != "CMakePackage")

    def named(self, directive):
        return [args[0] for name, args, _ in self.calls if name == directive]


class Recipes(unittest.TestCase):
    def test_spack_depends_on_what_the_build_needs(self):
        recipe = SpackRecipe("pbmpi")
        depends = {re.split(r"[@+: ]", spec)[0] for spec in recipe.named("depends_on")}
        for package in debian_packages():
            self.assertIn(package, SPACK, "jobs/install_packages.sh has a package of which the Spack recipe knows nothing")
            if SPACK[package] is not None:
                self.assertIn(SPACK[package], depends)

    def test_spack_packages_are_named_as_their_folders_and_pinned(self):
        for folder in (PACKAGES / "spack/packages").iterdir():
            recipe = SpackRecipe(folder.name)
            self.assertEqual(re.sub(r"(?<!^)(?=[A-Z])", "-", recipe.package.__name__).lower(), folder.name)
            self.assertTrue(recipe.package.__doc__)
            for name, _, named in recipe.calls:
                if name == "resource":
                    self.assertRegex(named["sha256"], r"^[0-9a-f]{64}$")

    def cmake_args(self, *variants):
        """What the recipe gives cmake, with these variants."""
        python = types.SimpleNamespace(command=types.SimpleNamespace(path="/spack/bin/python3"),
                                       version=types.SimpleNamespace(up_to=lambda count: ".".join("3 11 2".split()[:count])))
        package = SpackRecipe("pbmpi").package()
        package.spec = type("Spec", (dict,), {"satisfies": lambda self, variant: variant in variants})(python=python)
        package.stage = types.SimpleNamespace(source_path="/source")
        package.define = lambda name, value: (name, value)
        package.cmake_args.__func__.__globals__["join_path"] = lambda *parts: "/".join(parts)
        return dict(package.cmake_args())

    def test_spack_sets_options_that_the_build_has(self):
        cmake = "".join((SOURCE / folder / "CMakeLists.txt").read_text(encoding="utf-8") for folder in (".", "src/app/reports", "src/api/python"))
        for name, value in self.cmake_args("+python").items():
            self.assertRegex(cmake, rf"\({name}\b", name)
            if name.endswith("_JS"):  # where Debian's package, unpacked, has the file
                installed = pathlib.Path("/" + value.split("/", 3)[3])
                self.assertTrue(installed.is_file(), installed)

    def test_spack_builds_the_module_for_its_own_python_or_not_at_all(self):
        given = self.cmake_args("+python")
        self.assertEqual((given["PBMPI_PYTHON"], given["PBMPI_PYTHON_DIR"]), ("/spack/bin/python3", "lib/python3.11/site-packages"))
        without = self.cmake_args()
        self.assertNotIn("PBMPI_PYTHON", without)
        package = next(name for name in without if name.startswith("CMAKE_DISABLE_FIND_PACKAGE_")).rpartition("_")[2]
        self.assertIn(f"find_package({package} ", (SOURCE / "src/api/python/CMakeLists.txt").read_text(encoding="utf-8"))

    def test_docker_instructions_are_known_and_name_files_that_are_there(self):
        text = re.sub(r"\\\n", " ", DOCKERFILE.read_text(encoding="utf-8"))
        lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
        self.assertEqual(lines[0].split()[0], "FROM")
        for line in lines:
            instruction, rest = line.split(None, 1)
            self.assertIn(instruction, {"FROM", "WORKDIR", "COPY", "RUN", "USER", "CMD"})
            if instruction == "RUN":
                subprocess.run(["bash", "-n", "-c", rest], check=True)
            if instruction == "COPY" and not rest.startswith("--from"):
                self.assertTrue((SOURCE / rest.split()[0]).exists(), line)

    def test_apptainer_sections_are_known_and_their_scripts_parse(self):
        header, *sections = re.split(r"^%", APPTAINER.read_text(encoding="utf-8"), flags=re.MULTILINE)
        self.assertEqual(re.findall(r"^(\w+):", header, re.MULTILINE), ["Bootstrap", "From"])
        for section in sections:
            name, body = section.split("\n", 1)
            self.assertIn(name, {"files", "post", "runscript", "test", "labels"})
            if name in ("post", "runscript", "test"):
                subprocess.run(["sh", "-n", "-c", body], check=True)

    def test_containers_have_no_list_of_packages_of_their_own(self):
        for recipe in (DOCKERFILE, APPTAINER):
            text = re.sub(r"\\\n", " ", recipe.read_text(encoding="utf-8"))
            self.assertIn("jobs/install_packages.sh --packages", text)
            self.assertIn("jobs/package.sh", text)
            for line in re.findall(r"apt-get install ([^&\n]*)", text):
                self.assertEqual([word for word in line.split() if not word.startswith("-")], ["/srv/packages/*.deb"])
            for script in re.findall(r"\bjobs/\w+\.sh\b", text):
                self.assertTrue((SOURCE / script).exists())

    def test_both_module_files_set_the_same_paths(self):
        lua = (PACKAGES / "modules/pbmpi.lua").read_text(encoding="utf-8")
        tcl = (PACKAGES / "modules/pbmpi").read_text(encoding="utf-8")
        self.assertTrue(tcl.startswith("#%Module1.0\n"))
        in_lua = {(name, re.sub(r'pathJoin\(prefix, "(.*)"\)', r"\1", path).replace("prefix", ""))
                  for name, path in re.findall(r'^prepend_path\("(\w+)", (.*)\)$', lua, re.MULTILINE)}
        in_tcl = {(name, path.lstrip("/")) for name, path in re.findall(r"^prepend-path (\w+) \$prefix(.*)$", tcl, re.MULTILINE)}
        self.assertEqual(in_lua, in_tcl)
        self.assertGreater(len(in_lua), 4)


if __name__ == "__main__":
    unittest.main()
