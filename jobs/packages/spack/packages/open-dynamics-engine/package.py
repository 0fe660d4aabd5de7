from spack.package import *


class OpenDynamicsEngine(CMakePackage):
    """The Open Dynamics Engine (ODE): rigid bodies, joints and collision detection."""

    homepage = "https://www.ode.org"
    url = "http://deb.debian.org/debian/pool/main/o/ode/ode_0.16.2.orig.tar.gz"

    license("BSD-3-Clause OR LGPL-2.1-or-later")

    version("0.16.2", sha256="b26aebdcb015e2d89720ef48e0cb2e8a3ca77915f89d853893e7cc861f810f22")

    depends_on("c", type="build")
    depends_on("cxx", type="build")

    def cmake_args(self):
        # As Debian builds it: double precision, libccd (the copy in the sources) for cylinders.
        return [
            self.define("ODE_DOUBLE_PRECISION", True),
            self.define("ODE_WITH_LIBCCD", True),
            self.define("ODE_WITH_DEMOS", False),
            self.define("ODE_WITH_TESTS", False),
        ]
