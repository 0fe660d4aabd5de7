"""The shared library shows what its header says and needs no HDF5 or Boost: test_symbols.py LIBPBMPI."""
import re
import subprocess
import sys
import unittest

LIBRARY = sys.argv.pop(1)


def lines_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


class SymbolsTest(unittest.TestCase):
    def test_its_symbols_are_those_of_the_header(self):
        symbols = [line.split(maxsplit=2)[2] for line in lines_of("nm", "--dynamic", "--defined-only", "--demangle", LIBRARY)]
        shown = re.compile(r"PBMPI_0|pbmpi::(Batch::~?\w+=?|version)(\[abi:cxx11\])?\(.*\)( const)?@@PBMPI_0")
        self.assertEqual([symbol for symbol in symbols if not shown.fullmatch(symbol)], [])
        self.assertIn("pbmpi::Batch::step(int)@@PBMPI_0", symbols)

    def test_it_needs_no_library_of_files_or_options(self):
        needed = [line for line in lines_of("readelf", "--dynamic", LIBRARY) if "(NEEDED)" in line]
        self.assertTrue(any("libode" in line for line in needed), needed)
        self.assertEqual([line for line in needed if re.search("hdf5|boost", line)], [])


if __name__ == "__main__":
    unittest.main()
