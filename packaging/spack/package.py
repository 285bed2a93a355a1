# Recipe for Spack. In the folder of the project, with this file in a repository of packages: `spack dev-build camroller@0.2.0`.
from spack.package import *


class Camroller(Package):
    """Friction, slip and drive torque of roller-finger-follower valve trains."""

    license("MIT")

    version("0.2.0")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("fpm", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("hdf5+fortran+hl~mpi")
    depends_on("openblas")

    conflicts("%gcc@:11")

    def install(self, spec, prefix):
        which("bash")("packaging/install.sh", prefix)
