// volk's definitions, once.
#define VOLK_IMPLEMENTATION
#include <volk.h>
