// SPDX-License-Identifier: Apache-2.0
#include "cli/names.hpp"

#include <algorithm>
#include <filesystem>

#include "base/machine_error.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/volume/volume_file.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::cli {

bool is_name(const std::string& word) {
  std::error_code ignored;
  const auto name = word.substr(0, word.find(':'));
  return name.find_first_of("/.") == std::string::npos && !std::filesystem::exists(word, ignored);
}

void as_word(const std::string& word, const std::function<void()>& resolve) {
  try {
    resolve();
  } catch (const UserError& error) {
    if (error.code() != ExitCode::Input || !is_name(word)) throw;
    throw_again(error, error.parts(), ExitCode::Usage);
  }
}

void check_volume_name(const std::string& word) {
  const auto known = volume::known_volume_names();
  // A known scan that is not installed is a missing file.
  const bool scan = word.find(':') == std::string::npos && std::find(known.begin(), known.end(), word) != known.end();
  if (is_name(word) && !scan) as_word(word, [&] { volume::read_volume_header(word); });
}

std::vector<std::string> index_kinds() {
  const auto names = cmodel::find_key("index.kind")->names;
  return {names.begin(), names.end()};
}

std::vector<std::string> pattern_words() { return {"always", "every-", "alternate-", "random-", "burst-"}; }

std::vector<std::string> ready_words() {
  auto words = pattern_words();
  words.emplace_back("all");
  return words;
}

std::vector<std::string> stimulus_words() {
  std::vector<std::string> words{"all"};
  for (const auto which : testbench::stimulus_classes()) words.emplace_back(testbench::to_string(which));
  return words;
}

}  // namespace fastsplat::cli
