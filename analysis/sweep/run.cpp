// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>

#include "analysis/sweep/child.hpp"
#include "analysis/sweep/outcome.hpp"
#include "analysis/sweep/scratch.hpp"
#include "base/error.hpp"
#include "base/json_text.hpp"
#include "base/read_file.hpp"

namespace fastsplat::plan {
namespace {

namespace fs = std::filesystem;

/// A case in progress.
struct Going {
  const Case* one;
  std::size_t step = 0;
  fs::path folder;  ///< its own, in the scratch
  CaseResult result;
  bool accident = false;  ///< the machine failed; `result` holds the message and is not published
  double cpu_seconds = 0.0;
};

class Runner {
 public:
  Runner(const Plan& plan, const RunOptions& options) : options_(options), scratch_(options.results) {
    for (const char* folder : {kSharedFolder, kTimesFolder, kFailuresFolder})
      Scratch::make_folder(options.results / folder);
    for (std::size_t at = 0; at < plan.cases.size(); ++at) {
      if (!options.shard.has(at)) continue;
      ++summary_.cases;
      const Case& one = plan.cases[at];
      if (const auto done = done_before(one)) {
        ++summary_.skipped;
        count(*done);
      } else {
        waiting_.push_back(&one);
      }
    }
  }

  RunSummary run() {
    report_progress();
    fill();
    while (!going_.empty()) {
      const auto ended = children_.wait();
      if (!ended) {
        summary_.signal = children_.signal();
        children_.end_all();
        break;
      }
      summary_.cpu_seconds += ended->cpu_seconds;
      take(*ended);
      fill();
    }
    return summary_;
  }

 private:
  /// The existing result, unless the case must run again.
  std::optional<CaseResult> done_before(const Case& one) const {
    const fs::path path = result_path(options_.results, one.id);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return std::nullopt;
    CaseResult result;
    try {
      result = read_result(path);
    } catch (const UserError& error) {
      if (options_.note) options_.note(std::string(error.what()) + "; this case is run again");
      return std::nullopt;
    }
    if (const auto why = foreign(result, one, options_.program_hash); !why.empty()) {
      if (options_.replace_foreign) return std::nullopt;
      throw_input({.where = path.string(),
                   .what = why,
                   .expected = "program " + options_.program_hash,
                   .got = {},
                   .fix = "use another folder (--results), or replace such results with --again"});
    }
    if (options_.retry_failed && result.status != Status::Pass) return std::nullopt;
    return result;
  }

  void count(const CaseResult& result) {
    ++(result.status == Status::Pass   ? summary_.passed
       : result.status == Status::Fail ? summary_.failed
                                       : summary_.errors);
  }

  void report_progress() const {
    const std::size_t done = summary_.passed + summary_.failed + summary_.errors + summary_.accidents;
    if (options_.progress) options_.progress(done, summary_.cases);
  }

  /// Starts as many cases as there are free jobs.
  void fill() {
    while (going_.size() < options_.jobs && !ready_.empty()) {
      Going next = std::move(ready_.front());
      ready_.pop_front();
      advance(std::move(next));
    }
    while (going_.size() < options_.jobs && !waiting_.empty()) {
      const Case* one = waiting_.front();
      waiting_.pop_front();
      Going next{.one = one, .folder = scratch_.fresh(one->id), .result = {}};
      next.result.id = one->id;
      next.result.kind = one->kind;
      next.result.content = one->content;
      next.result.program = options_.program_hash;
      advance(std::move(next));
    }
  }

  fs::path shared_path(const std::string& name) const {
    // Another program may make another picture of the same scene.
    return options_.results / kSharedFolder / (options_.program_hash + "-" + name);
  }

  /// Starts the case's next run, or parks the case until a shared file is made, or finishes the case.
  void advance(Going going) {
    while (going.step < going.one->steps.size()) {
      const Step& step = going.one->steps[going.step];
      if (!step.shared.empty()) {
        std::error_code ignored;
        if (const auto broken = broken_.find(step.shared); broken != broken_.end()) {
          take_outcome(going, broken->second);
          return finish(std::move(going));
        }
        if (making_.contains(step.shared)) {
          parked_[step.shared].push_back(std::move(going));
          return;
        }
        if (fs::exists(shared_path(step.shared), ignored)) {
          ++going.step;
          continue;
        }
        making_.insert(step.shared);
      }
      const pid_t pid = children_.start(options_.program, words_of(going, step));
      going_.emplace(pid, std::move(going));
      return;
    }
    finish(std::move(going));
  }

  /// The step's words with real file names, and the flags of every run.
  Words words_of(const Going& going, const Step& step) const {
    std::set<std::string> shared;
    for (const Step& other : going.one->steps) shared.insert(other.shared);
    Words words;
    for (const auto& word : step.words) {
      const auto file = file_of(word);
      if (!file) {
        words.push_back(word);
      } else if (shared.contains(*file) && *file != step.shared) {
        words.push_back(shared_path(*file).string());
      } else {
        words.push_back((going.folder / *file).string());
      }
    }
    if (!step.result.empty()) words.insert(words.end(), {"--json", (going.folder / kJson).string()});
    words.insert(words.end(), {"--quiet", "--threads", std::to_string(options_.threads)});
    return words;
  }

  void take(const Ended& ended) {
    auto node = going_.extract(ended.pid);
    Going going = std::move(node.mapped());
    const Step& step = going.one->steps[going.step];
    going.cpu_seconds += ended.cpu_seconds;
    Outcome outcome = outcome_of(step, ended, {.folder = going.folder, .shared = options_.results / kSharedFolder});
    if (const std::string why = options_.changed ? options_.changed() : ""; !why.empty()) {
      outcome.status = Status::Error;
      outcome.accident = true;
      outcome.message = why;
    }
    if (!step.shared.empty()) {
      making_.erase(step.shared);
      if (outcome.status == Status::Pass) {
        Scratch::publish(going.folder / step.shared, shared_path(step.shared));
      } else {
        broken_[step.shared] = outcome;
      }
      auto woken = parked_.extract(step.shared);
      if (!woken.empty()) {
        for (Going& other : woken.mapped()) ready_.push_back(std::move(other));
      }
    }
    take_outcome(going, outcome);
    // A broken limit does not invalidate later figures.
    if (outcome.status == Status::Error) return finish(std::move(going));
    ++going.step;
    advance(std::move(going));
  }

  static void take_outcome(Going& going, const Outcome& outcome) {
    CaseResult& result = going.result;
    if (!outcome.json.is_null()) result.results[going.one->steps[going.step].result] = outcome.json;
    if (!outcome.coverage.is_null()) result.coverage = outcome.coverage;
    going.accident |= outcome.accident;
    if (outcome.status == Status::Pass || result.status == Status::Error) return;
    if (result.status == Status::Fail && outcome.status == Status::Fail) {
      result.message += "; " + outcome.message;
      return;
    }
    result.status = outcome.status;
    result.exit_code = outcome.exit_code;
    result.message = outcome.message;
  }

  void finish(Going going) {
    std::error_code ignored;
    if (going.accident) {
      fs::remove_all(going.folder, ignored);
      ++summary_.accidents;
      if (options_.accident) options_.accident(*going.one, going.result.message);
      return report_progress();
    }
    keep_evidence(going);
    const fs::path written = going.folder / "result";
    write_file(written, to_text(going.result));
    Scratch::publish(written, result_path(options_.results, going.one->id));
    write_file(written, fmt::format("{{\"cpu_seconds\": {:.3f}}}\n", going.cpu_seconds));
    Scratch::publish(written, options_.results / kTimesFolder / (going.one->id + ".json"));
    fs::remove_all(going.folder, ignored);
    count(going.result);
    if (options_.finished) options_.finished(*going.one, going.result);
    if (options_.unharmed && !waiting_.empty()) options_.unharmed(*going.one);
    report_progress();
  }

  /// Keeps the small stream and waveform of a failed verification: failures/ID.fss and .fst.
  void keep_evidence(const Going& going) const {
    for (const char* ending : {".fss", ".fst"}) {
      std::error_code ignored;
      const fs::path made = going.folder / (std::string(kFailure) + ending);
      if (!fs::exists(made, ignored)) continue;
      Scratch::publish(made, options_.results / kFailuresFolder / (going.one->id + ending));
    }
  }

  const RunOptions& options_;
  RunSummary summary_;
  Scratch scratch_;
  Children children_;
  std::deque<const Case*> waiting_;  ///< not begun
  std::deque<Going> ready_;          ///< the shared file they waited for exists
  std::map<pid_t, Going> going_;
  std::set<std::string> making_;                      ///< shared files being made
  std::map<std::string, std::vector<Going>> parked_;  ///< cases that wait for one of them
  std::map<std::string, Outcome> broken_;             ///< shared files that could not be made, and why
};

}  // namespace

RunSummary run(const Plan& plan, const RunOptions& options) { return Runner(plan, options).run(); }

}  // namespace fastsplat::plan
