// volk, under names that no host program has: cmake/volk.cmake says why.
#include "volk_names.h"

#include <volk.c>
