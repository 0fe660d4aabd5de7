"""What "pbstudy prediction" runs and writes: pbmpi, alone or under the Valgrind tool pbvalue, and "pbreport diff"."""
