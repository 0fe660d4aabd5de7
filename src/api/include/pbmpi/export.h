/// Marks what the shared library exports.
#pragma once

#define PBMPI_EXPORT __attribute__((visibility("default")))
