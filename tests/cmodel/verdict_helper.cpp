// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/verdict_helper.hpp"

#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/oracle/stream.hpp"

namespace fastsplat::test {
namespace {

/// N of "beat N (byte offset 24 N)"; any other text is not a place in a stream.
std::optional<std::uint64_t> beat_of(const std::string& where) {
  if (where.rfind("beat ", 0) != 0) return std::nullopt;
  const std::uint64_t beat = std::stoull(where.substr(5));
  if (where != "beat " + std::to_string(beat) + " (byte offset " + std::to_string(beat * cmodel::kBeatBytes) + ")")
    return std::nullopt;
  return beat;
}

std::string text_of(const Verdict& verdict) {
  return verdict.refused_at ? "refuses beat " + std::to_string(*verdict.refused_at) + " (" + verdict.text + ")"
                            : "takes it";
}

}  // namespace

Verdict model_verdict(const cmodel::Config& config, std::span<const std::uint8_t> bytes, oracle::Rendering* out) {
  try {
    oracle::Rendering rendering = run_model(config, bytes);
    if (out != nullptr) *out = std::move(rendering);
    return {};
  } catch (const UserError& error) {
    const auto beat = beat_of(error.parts().where);
    return {beat ? *beat : ~std::uint64_t{0}, error.what(), error.parts(), error.code()};
  }
}

Verdict oracle_verdict(const cmodel::Config& config, std::span<const std::uint8_t> bytes, oracle::Rendering* out) {
  try {
    oracle::Rendering rendering = oracle::render(symbols_of(config), bytes);
    if (out != nullptr) *out = std::move(rendering);
    return {};
  } catch (const oracle::Refusal& refusal) {
    return {refusal.beat, refusal.what(), {}, ExitCode::Input};
  }
}

std::string disagreement(const cmodel::Config& config, std::span<const std::uint8_t> bytes, bool* taken) {
  oracle::Rendering got, want;
  const Verdict model = model_verdict(config, bytes, &got), expected = oracle_verdict(config, bytes, &want);
  if (taken != nullptr) *taken = !model.refused_at.has_value();
  if (model.refused_at != expected.refused_at) return "model " + text_of(model) + ", oracle " + text_of(expected);
  if (model.refused_at) return model.code == ExitCode::Input ? "" : "refused, but not as bad input: " + model.text;
  return compare(got, want).first;
}

}  // namespace fastsplat::test
