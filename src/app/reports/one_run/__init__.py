"""pbreport's reports on the files of one run, or of two that are compared."""
