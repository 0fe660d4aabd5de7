"""The study of value prediction (jobs/paper/predict.py): pbmpi, alone or under the Valgrind tool pbvalue, and "pbreport diff"."""
