// SPDX-License-Identifier: Apache-2.0
#include "tests/formats/results_helper.hpp"

#include <stdexcept>

namespace fastsplat::report {
namespace {

const char* const kClosure = R"({"verb": "closure", "verdict": "open", "command": "tools/coverage",
  "bins": {"hit": 2, "all": 3}, "lines": {"reached": 8, "excused": 1, "all": 9},
  "tests": {"passed": 1, "failed": 0, "not_run": 1},
  "open": {"campaigns": [], "testpoints": ["hazards, tiny: hazard.distance_1 was never hit"], "lines": []},
  "testpoints": [
   {"name": "hazards", "status": "open", "bins": {"hit": 2, "all": 3}, "tests": [],
    "configurations": [{"config": "tiny", "hit": 1, "all": 2, "hits": {"hazard.distance_1": 0, "hazard.distance_2": 7}},
                       {"config": "base", "hit": 1, "all": 1, "hits": {"hazard.distance_2": 5}}]},
   {"name": "registers", "status": "closed", "bins": {"hit": 0, "all": 0}, "configurations": [],
    "tests": [{"test": "cmodel.A.B", "runs": 1, "outcome": "passed"}]},
   {"name": "proofs", "status": "not run", "bins": {"hit": 0, "all": 0}, "configurations": [],
    "tests": [{"test": "rtl.proof", "runs": 0, "outcome": "not run"}]}]})";

const char* const kCompare = R"({"verb": "compare", "command": "fastsplat compare a.exr 'b c.exr' --max-lsb 1",
  "schema": "fastsplat.compare/1", "verdict": "fail", "width": 4, "height": 4, "channels": 4, "values": 64, "lsb_bits": 8,
  "psnr_db": 51.438417427108874, "identical": false, "max_abs_lsb": 8.1, "ssim": 0.99,
  "percentiles_lsb": {"p99": 3.0}, "histogram": [], "clusters": [],
  "floor": {"psnr_db": 65.35, "identical": false, "max_abs_lsb": 0.499, "ssim": 0.999, "percentiles_lsb": {"p99": 0.4}},
  "limits": [{"name": "min_psnr_db", "limit": 60.0, "got": 51.438417427108874, "ok": false},
             {"name": "max_abs_lsb", "limit": 9.0, "got": 8.1, "ok": true},
             {"name": "max_nonfinite", "limit": 0.0, "got": 0.0, "ok": true}]})";

const char* const kCoverage = R"({"verb": "coverage", "format": "fastsplat coverage 1", "config": "tiny",
  "campaigns": {"stream": {"fifo.full": 3, "fifo.empty": 0}, "scene": {"fifo.full": 1}}})";

const char* const kCycles = R"({"verb": "cycles", "config": {"name": "tiny"}, "command": "fastsplat cycles",
  "cycles": {"actual": 110, "account": {"ideal": 100, "records": 4, "drain": 6, "output": 0}}, "actual_to_ideal": 1.1,
  "seconds": 0.5})";

const char* const kErrors = R"({"verb": "errors", "total": {"rms_lsb8": 2.0, "bias_lsb8": -0.25},
  "steps": [{"name": "snap", "steps": ["position", "snap"], "share": 0.75, "increment": {"rms_lsb8": 1.5, "bias_lsb8": -0.5}},
            {"name": "pixel", "steps": ["pixel"], "share": 0.25, "increment": {"rms_lsb8": 0.5, "bias_lsb8": 0.25}}]})";

const char* const kErrorsFile = R"({"verb": "errors file", "file": {"rms_lsb8": 2.0}, "device": {"rms_lsb8": 0.5},
  "total": {"rms_lsb8": 2.25}, "parts": [{"name": "position", "by": "file", "share": 0.75, "rms_lsb8": 1.5, "alone": {"psnr_db": 45.5}},
                                        {"name": "pixel", "by": "device", "share": 0.25, "rms_lsb8": 0.5}]})";

const char* const kBound = R"({"verb": "errors bound", "holds": true,
  "levels": [{"known": "scene", "values": 64, "over": 0, "greatest_bound_lsb8": 9.5, "greatest_error_lsb8": 2.25}]})";

const char* const kPropose = R"({"verb": "errors propose", "target": "psnr>=50", "met": false, "judged": 12,
  "cost_from": {"total": 100.0}, "cost": {"total": 40.0},
  "keys": [{"key": "snap.phases", "from": "64", "proposed": "4", "excess_if_lower": 1.25}]})";

const char* const kRanges = R"({"verb": "errors ranges",
  "sites": [{"site": "snap", "format": "S 8.3", "values": 4000, "saturated": 0, "lost": {"mean_ulp": 0.0}}]})";

const char* const kFamily = R"({"verb": "family", "cells": [
  {"kind": "rlut", "grid": 4, "aligned": {"max": 5.9}, "remarks": ["one, and \"two\"", "three"]},
  {"kind": "linear", "grid": 8, "aligned": {"max": 1.5}, "root_steps": 9}]})";

const char* const kPlan = R"({"verb": "plan", "name": "words", "hash": "00ff", "rows": [
  {"id": "a1", "kind": "compare", "status": "pass", "axes": {"lanes": 8, "method": "xray"}, "metrics": {"psnr_db": 50.5},
   "config_hash": "c1", "command": "fastsplat compare a b"},
  {"id": "b2", "kind": "compare", "status": "fail", "message": "max_abs_lsb is 9, no more than 3 allowed",
   "axes": {"lanes": 4, "method": "xray"}, "metrics": {"psnr_db": 30.25}, "config_hash": "c2",
   "command": "fastsplat compare a 'c, d'"},
  {"id": "c3", "kind": "verify", "status": "error", "message": "timeout\nafter 5 s", "axes": {}, "metrics": {},
   "config_hash": "c3", "command": "fastsplat verify --random 9"}]})";

const char* const kRender =
    R"({"verb": "render", "engine": "golden", "scene": {"volume": "shells:16", "width": 32, "height": 32}})";

const char* const kRecord = R"({"verb": "stream record", "stream": "s.fss"})";

const char* const kReplay = R"({"verb": "stream replay", "stream": "s.fss", "width": 32, "height": 32,
  "counters": {"tiles": 1, "splats": 2000}})";

const char* const kVerify =
    R"({"verb": "verify", "verdict": "mismatch", "comparisons": 300, "mismatches": 2, "splats": 60,
  "cycles_rtl": 90, "cycles_model": 91, "seed": 7, "seeds": 3, "config": "tiny", "by_tap": {"snap": 100, "pixel": 200},
  "command": "fastsplat verify --random 20 --seed 7 --seeds 3 --config tiny",
  "by_seed": [{"seed": 7, "verdict": "pass", "comparisons": 100, "mismatches": 0},
              {"seed": 8, "verdict": "mismatch", "comparisons": 100, "mismatches": 1},
              {"seed": 9, "verdict": "mismatch", "comparisons": 100, "mismatches": 1}],
  "failure": {"first": "seed 8: pixel 3,4 is 0x1f, expected 0x20", "smallest": "2 splats: tap sheet <lane 3> & more",
              "operands": "", "replay": "fastsplat verify --stream verify-failure.fss --config tiny"}})";

}  // namespace

Result result_from(const std::string& file, const std::string& text) {
  Json json = Json::parse(text);
  const std::string subcommand = json.at("verb");
  return {.file = file, .subcommand = subcommand, .json = std::move(json)};
}

std::vector<Result> all_kinds() {
  std::vector<Result> results;
  for (const char* text : {kCompare, kCycles, kErrors, kErrorsFile, kBound, kPropose, kRanges, kFamily, kPlan, kRender,
                           kRecord, kReplay, kVerify, kCoverage, kClosure})
    results.push_back(result_from("result-" + std::to_string(results.size()) + ".json", text));
  return results;
}

Result kind(const std::string& subcommand) {
  for (const Result& result : all_kinds()) {
    if (result.subcommand == subcommand) return result;
  }
  throw std::out_of_range(subcommand);
}

}  // namespace fastsplat::report
