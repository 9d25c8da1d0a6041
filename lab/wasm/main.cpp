// SPDX-License-Identifier: Apache-2.0
// The functions that the page's worker calls. Results stay valid until the next lab_answer().
#include <cstddef>
#include <cstdint>

#include "lab/session.hpp"

namespace {
fastsplat::lab::Session session;
fastsplat::lab::Answer answer;
}  // namespace

extern "C" {
/// Answers a request, one JSON object; returns the number of pictures.
std::size_t lab_answer(const char* request) {
  answer = {};
  answer = session.answer(request);
  return answer.pictures.size();
}
const char* lab_json() { return answer.json.c_str(); }
/// The words of picture `at`: width * height * channels.
const std::int32_t* lab_words(std::size_t at) { return answer.pictures[at].words.data(); }
}
