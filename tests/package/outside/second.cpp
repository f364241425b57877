#include <sightline/kernel/number.h>

std::string tenth_from_elsewhere() { return sightline::to_string(sightline::rational_from_string("10/100")); }
