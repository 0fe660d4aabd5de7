import glob

from spack.package import *


class Pbmpi(CMakePackage):
    """Many rigid-body worlds over MPI ranks, and what accuracy costs in time."""

    # There is no archive of a version yet: spack develop --path CHECKOUT pbmpi@main
    license("MIT")

    version("main")

    variant("python", default=True, description="Build the Python module")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("gzip", type="build")
    depends_on("help2man", type="build")
    depends_on("mpi")
    depends_on("hdf5@1.10: +mpi")
    depends_on("boost@1.74: +program_options")
    depends_on("eigen@3.4:3")
    depends_on("fmt@9:")
    depends_on("tomlplusplus")
    depends_on("pugixml")
    depends_on("nlohmann-json")
    depends_on("open-dynamics-engine@0.16:")
    with when("+python"):
        extends("python")
        depends_on("py-pybind11", type="build")
        depends_on("py-numpy", type=("build", "run"))
        depends_on("py-h5py", type="run")
        depends_on("py-pandas", type="run")

    # Report pages embed these two, in the form in which Debian packages them.
    resource(
        name="three",
        url="http://deb.debian.org/debian/pool/main/t/three.js/libjs-three_111+dfsg1-3_all.deb",
        sha256="1d04680b4ed560b851c63e7691ffe3a37307ad0858ea4e50e92b6147e575df84",
        expand=False,
        placement="libjs-three",
    )
    resource(
        name="chart",
        url="http://deb.debian.org/debian/pool/main/n/node-chart.js/libjs-chart.js_3.9.1+~0.2.1-2_all.deb",
        sha256="16456ab02ad662f480ae3f4d0769a069f69133d0a957821925bbdd648ae5390a",
        expand=False,
        placement="libjs-chart.js",
    )

    @run_before("cmake")
    def unpack_javascript(self):
        for folder in ("libjs-three", "libjs-chart.js"):
            with working_dir(join_path(self.stage.source_path, folder)):
                which("ar")("x", *glob.glob("*.deb"))
                which("tar")("xf", "data.tar.xz")

    def cmake_args(self):
        source = self.stage.source_path
        three = join_path(source, "libjs-three", "usr/share/javascript/three")
        chart = join_path(source, "libjs-chart.js", "usr/share/javascript/chart.js")
        # The build looks for Debian's own Python, unless it is told of another.
        python = [self.define("CMAKE_DISABLE_FIND_PACKAGE_pybind11", True)]
        if self.spec.satisfies("+python"):
            found = self.spec["python"]
            python = [
                self.define("PBMPI_PYTHON", found.command.path),
                self.define("PBMPI_PYTHON_DIR", f"lib/python{found.version.up_to(2)}/site-packages"),
            ]
        return python + [
            self.define("PBMPI_BUILD_TESTS", False),
            self.define("PBMPI_BUILD_BENCHMARKS", False),
            self.define("PBMPI_THREE_JS", join_path(three, "three.min.js")),
            self.define("PBMPI_ORBIT_CONTROLS_JS", join_path(three, "examples/js/controls/OrbitControls.js")),
            self.define("PBMPI_CHART_JS", join_path(chart, "chart.min.js")),
        ]
