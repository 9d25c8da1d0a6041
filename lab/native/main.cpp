// SPDX-License-Identifier: Apache-2.0
// The lab's engine as a native program, for tests: a request a line from stdin, an answer a line to stdout.
#include <iostream>
#include <string>

#include "lab/session.hpp"

int main() {
  fastsplat::lab::Session session;
  for (std::string line; std::getline(std::cin, line);) std::cout << session.answer(line).json << std::endl;
}
