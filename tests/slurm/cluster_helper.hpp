// SPDX-License-Identifier: Apache-2.0
// A Slurm cluster of this test alone: munged, slurmctld and one slurmd per node, on loopback, as the calling user,
// without accounting, everything in one temporary folder. Each setting exists for a reason that is given.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/process_helper.hpp"
#include "tests/slurm/process_tree_helper.hpp"

namespace fastsplat::slurm_test {

/// Why a cluster is impossible here, with the packages to install; empty if it is possible.
std::string why_no_cluster();

/// "JobState" -> "COMPLETED" of one job, or of one task of an array.
using Job = std::map<std::string, std::string>;

class Cluster {
 public:
  /// Nodes n1, n2 ... of one processor each, idle. `array_max`: the site's MaxArraySize. Throws with the ends of the
  /// logs if they do not start.
  explicit Cluster(int nodes, int array_max = 1001);
  /// Ends all daemons without messages.
  ~Cluster();
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  /// For work too: the cluster's own files are beside it in .slurm/, which other users may read.
  const cli_test::TempFolder& folder() const { return folder_; }
  /// The environment of a client: PATH and SLURM_CONF.
  std::vector<std::string> environment() const;
  /// A client's call, at most 20 seconds.
  cli_test::Result client(const std::vector<std::string>& words) const;
  /// The same; it must succeed. Returns its stdout without the last newline.
  std::string say(const std::vector<std::string>& words) const;

  /// All tasks of a job, or the one job; empty if it is unknown.
  std::vector<Job> jobs(const std::string& id) const;
  /// True if all of them have ended in any state.
  bool ended(const std::string& id) const;
  /// "idle", "down", "allocated*" ...
  std::string node_state(const std::string& node) const;
  void set_node(const std::string& node, const std::string& state) const;

  /// Simulates a power cut: kills the node's slurmd, its steps and their processes, and notifies the controller.
  void crash(const std::string& node);
  /// Starts the node's slurmd again and puts it back in service.
  void bring_back(const std::string& node);

  /// Cancels running jobs and ends the daemons. Returns the processes that remained (none are expected); they are
  /// killed.
  std::vector<std::string> end();
  /// The ends of the logs, for a failure's message.
  std::string logs() const;

 private:
  bool start();
  void write_settings();
  void start_node(const std::string& node);
  std::string node_name(int i) const { return "n" + std::to_string(i + 1); }

  cli_test::TempFolder folder_;
  std::filesystem::path home_;
  int nodes_, array_max_, port_ = 0;
  pid_t munged_ = 0, controller_ = 0;
  std::map<std::string, pid_t> daemons_;  ///< slurmd by node
  bool ended_ = false;
};

}  // namespace fastsplat::slurm_test
