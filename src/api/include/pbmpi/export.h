/// What the shared library shows.
#pragma once

#define PBMPI_EXPORT __attribute__((visibility("default")))
