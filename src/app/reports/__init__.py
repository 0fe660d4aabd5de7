"""What studies, and sets of runs, amount to: the commands of pbreport that read more than one run."""
