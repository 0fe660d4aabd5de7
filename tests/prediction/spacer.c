/* Takes up three pages where it is loaded. */
char pbmpi_spacer[3 * 4096] = {1};
