// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/journal.hpp"

#include <charconv>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/json_file.hpp"
#include "base/machine_error.hpp"

namespace fastsplat::analysis {
namespace {

const char* const kFirstLine = R"({"schema":"fastsplat.journal/1"})";

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line, const char* expected) {
  throw_input({.where = path.string() + ":" + std::to_string(line),
               .what = "invalid line of a journal",
               .expected = expected,
               .got = {},
               .fix = "use --journal with a new file, or one written by `fastsplat errors propose`"});
}

std::uint64_t hash_from(const nlohmann::json& json) {
  const auto& text = json.get_ref<const std::string&>();
  std::uint64_t hash = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (error != std::errc{} || end != text.data() + text.size() || text.size() != 16)
    throw std::invalid_argument("no hash");
  return hash;
}

}  // namespace

Journal::Journal(const std::filesystem::path& path) : path_(path) {
  if (path.empty()) return;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse(path, 1, "a file");
  std::uintmax_t whole = 0;  // bytes up to the last end of a line
  if (std::ifstream in(path, std::ios::binary); in) {
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
      if (in.eof()) {  // incomplete line; a file that begins with anything else is not a journal
        if (number == 0 && !std::string_view(kFirstLine).starts_with(line)) refuse(path, 1, kFirstLine);
        break;
      }
      if (++number == 1) {
        if (line != kFirstLine) refuse(path, 1, kFirstLine);
      } else {
        try {
          const auto json = parse_json<nlohmann::json>(line);
          Entry entry;
          if (json.at("drawn").get<bool>())
            entry = Fidelity{json.at("rms_lsb8").get<double>(), json.at("max_lsb8").get<double>()};
          entries_[{hash_from(json.at("config")), hash_from(json.at("scene"))}] = entry;
        } catch (const std::exception&) {
          refuse(path, number, R"({"config":HASH,"scene":HASH,"drawn":true,"rms_lsb8":X,"max_lsb8":Y})");
        }
      }
      whole += line.size() + 1;
    }
  }
  if (std::filesystem::exists(path, ignored) && std::filesystem::file_size(path, ignored) > whole)
    std::filesystem::resize_file(path, whole, ignored);
  out_.open(path, std::ios::binary | std::ios::app);
  if (whole == 0) out_ << kFirstLine << '\n' << std::flush;
  if (!out_) {
    throw_machine({.where = path.string(),
                   .what = "cannot write the journal",
                   .expected = {},
                   .got = {},
                   .fix = "name a writable file"});
  }
}

const Journal::Entry* Journal::find(std::uint64_t config, std::uint64_t scene) const {
  const auto found = entries_.find({config, scene});
  return found == entries_.end() ? nullptr : &found->second;
}

void Journal::add(std::uint64_t config, std::uint64_t scene, const Entry& entry) {
  entries_[{config, scene}] = entry;
  if (path_.empty()) return;
  nlohmann::ordered_json json{{"config", hash_text(config)}, {"scene", hash_text(scene)}, {"drawn", entry.has_value()}};
  if (entry) json["rms_lsb8"] = entry->rms_lsb, json["max_lsb8"] = entry->max_lsb;
  out_ << json.dump() + "\n" << std::flush;
  if (!out_) {
    throw_input({.where = path_.string(),
                 .what = "cannot write the journal",
                 .expected = {},
                 .got = {},
                 .fix = "check that the disk is not full"});
  }
}

}  // namespace fastsplat::analysis
