-- Module file for Lmod: copy it to MODULEPATH/pbmpi/VERSION.lua, and name the prefix of `cmake --install`.
local prefix = "/opt/pbmpi"

help("pbmpi: rigid-body worlds over MPI ranks. pbmpi --help, man pbmpi, " .. prefix .. "/share/doc/pbmpi")
whatis("Name: pbmpi")
whatis("Description: many rigid-body worlds over MPI ranks, and what accuracy costs in time")

prepend_path("PATH", pathJoin(prefix, "bin"))
prepend_path("LD_LIBRARY_PATH", pathJoin(prefix, "lib"))
prepend_path("CMAKE_PREFIX_PATH", prefix)
prepend_path("PKG_CONFIG_PATH", pathJoin(prefix, "lib/pkgconfig"))
prepend_path("PYTHONPATH", pathJoin(prefix, "lib/python3/dist-packages"))
prepend_path("MANPATH", pathJoin(prefix, "share/man"))
