// SPDX-License-Identifier: Apache-2.0
// A Slurm cluster of this test alone: munged, slurmctld and a slurmd a node, on loopback, as the calling user, without
// accounting, everything in one temporary folder. The settings and why: each is there for something that was seen.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/process_helper.hpp"
#include "tests/slurm/process_tree_helper.hpp"

namespace fastsplat::slurm_test {

/// Why there can be no cluster here, with what to install; empty when there can.
std::string why_no_cluster();

/// "JobState" -> "COMPLETED" of one job, or of one task of an array.
using Job = std::map<std::string, std::string>;

class Cluster {
 public:
  /// Nodes n1, n2 ... of one processor each, idle. `array_max`: the site's MaxArraySize. Throws with the ends of the
  /// logs when they do not come up.
  explicit Cluster(int nodes, int array_max = 1001);
  /// Ends everything, quietly.
  ~Cluster();
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  /// For work too: the cluster's own files lie beside in .slurm/, which other users may read.
  const cli_test::TempFolder& folder() const { return folder_; }
  /// What a client needs: PATH and SLURM_CONF.
  std::vector<std::string> environment() const;
  /// A client's call, at most 20 seconds.
  cli_test::Result client(const std::vector<std::string>& words) const;
  /// The same, of which success is expected; its stdout without the last newline.
  std::string say(const std::vector<std::string>& words) const;

  /// All tasks of a job, or the one job; empty when it is not known.
  std::vector<Job> jobs(const std::string& id) const;
  /// True when all of them have ended, however.
  bool ended(const std::string& id) const;
  /// "idle", "down", "allocated*" ...
  std::string node_state(const std::string& node) const;
  void set_node(const std::string& node, const std::string& state) const;

  /// Simulates a power cut: kills the node's slurmd, its steps and their processes, and notifies the controller.
  void crash(const std::string& node);
  /// Starts the node's slurmd again and puts it back in service.
  void bring_back(const std::string& node);

  /// Cancels what runs and ends the daemons. Processes that were left then (there should be none), and are killed.
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
