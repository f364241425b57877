#include <headers.h>

#include <iostream>

std::string tenth_from_elsewhere();

int main() {
  std::cout << sightline::to_string(sightline::exact_decimal(1, -1)) << ' ' << tenth_from_elsewhere() << '\n';
}
