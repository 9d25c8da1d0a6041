// SPDX-License-Identifier: Apache-2.0
#include "tests/slurm/cluster_helper.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace fastsplat::slurm_test {
namespace {

namespace fs = std::filesystem;
using cli_test::read_bytes;

constexpr double kStart = 15.0;  ///< seconds until a daemon must be ready

/// Daemons are in folders that a plain user's shell does not search.
std::string path_setting() {
  const char* path = std::getenv("PATH");
  return "PATH=" + std::string(path == nullptr ? "/usr/bin:/bin" : path) + ":/usr/sbin:/sbin";
}

std::string user_name() {
  const passwd* entry = ::getpwuid(::geteuid());
  return entry == nullptr ? std::string() : entry->pw_name;
}

bool is_free(int port) {
  const int end = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool free = ::bind(end, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(end);
  return free;
}

/// The first of `count` consecutive free ports, below the kernel's own range.
int free_ports(int count) {
  std::random_device chance;
  for (int tries = 0; tries < 1000; ++tries) {
    const int first = 10000 + static_cast<int>(chance() % 20000);
    bool all = true;
    for (int i = 0; i < count && all; ++i) all = is_free(first + i);
    if (all) return first;
  }
  throw std::runtime_error("no free ports");
}

std::string tail(const fs::path& file) {
  const std::string text = read_bytes(file);
  return text.size() < 2000 ? text : "..." + text.substr(text.size() - 2000);
}

/// 22 of "slurm 22.05.8"; 0 if it is not printed.
int slurm_release() {
  cli_test::Surroundings with_daemons;
  with_daemons.environment = {path_setting()};
  std::istringstream words(cli_test::run_words({"slurmd", "-V"}, with_daemons).out);
  std::string name;
  int release = 0;
  words >> name >> release;
  return release;
}

/// "JobId=1 JobState=PENDING Command=..." as a map. A value may hold blanks; a name never does.
Job job_from(const std::string& line) {
  static const std::regex name(R"((^| )([A-Za-z/:]+)=)");
  Job job;
  std::string last;
  std::size_t value = 0;
  for (std::sregex_iterator it(line.begin(), line.end(), name), none; it != none; ++it) {
    if (!last.empty()) job[last] = line.substr(value, static_cast<std::size_t>(it->position()) - value);
    last = (*it)[2];
    value = static_cast<std::size_t>(it->position() + it->length());
  }
  if (!last.empty()) job[last] = line.substr(value);
  return job;
}

}  // namespace

std::string why_no_cluster() {
  std::string missing;
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue"}) {
    cli_test::Surroundings with_daemons;
    with_daemons.environment = {path_setting()};
    if (cli_test::run_words({"sh", "-c", "command -v " + std::string(program)}, with_daemons).code != 0)
      missing += (missing.empty() ? "" : ", ") + std::string(program);
  }
  if (!missing.empty()) {
    return "no Slurm here (missing: " + missing +
           "): apt-get install --no-install-recommends slurmctld slurmd slurm-client munge";
  }
  if (user_name().empty()) return "no Slurm here: the calling user has no name";
  std::array<char, 256> host{};
  addrinfo* found = nullptr;
  if (::gethostname(host.data(), host.size() - 1) != 0 || ::getaddrinfo(host.data(), nullptr, nullptr, &found) != 0)
    return std::string("no Slurm here: this machine's own name, ") + host.data() + ", has no address (/etc/hosts)";
  ::freeaddrinfo(found);
  // A unix socket's name has 107 characters at most, and munge's lies some folders below.
  if (fs::temp_directory_path().string().size() > 60) return "no Slurm here: TMPDIR is too long for munge's socket";
  return {};
}

Cluster::Cluster(int nodes, int array_max) : home_(folder_.path() / ".slurm"), nodes_(nodes), array_max_(array_max) {
  // munge refuses a socket in a folder that others may not enter.
  fs::permissions(folder_.path(), fs::perms(0755));
  for (const char* part : {"", "munge", "state", "spool", "run", "log"}) {
    fs::create_directories(home_ / part);
    fs::permissions(home_ / part, fs::perms(0755));
  }
  // Another process may take a port between its choice and its use.
  if (start() || (end(), ended_ = false, start())) return;
  const std::string said = logs();
  end();
  throw std::runtime_error("the cluster did not come up:\n" + said);
}

Cluster::~Cluster() {
  if (!ended_) end();
}

void Cluster::write_settings() {
  const std::string d = home_.string();
  std::ofstream out(d + "/slurm.conf");
  out << "ClusterName=test\nSlurmctldHost=localhost\n"
      << "SlurmUser=" << user_name() << "\nSlurmdUser=" << user_name()
      << "\n"
      // A requeued task waits until its credential has expired: 120 s by default; values below 5 s are ignored.
      << "AuthType=auth/munge\nAuthInfo=socket=" << d
      << "/munge/sock,cred_expire=5\n"
      // Loopback only; without EnableIPv6 names do not resolve if there is no other interface.
      << "CommunicationParameters=NoInAddrAny,NoCtldInAddrAny,EnableIPv6\nSlurmctldPort=" << port_ << "\n"
      << "StateSaveLocation=" << d << "/state\nSlurmdSpoolDir=" << d << "/spool/%n\n"
      << "SlurmctldPidFile=" << d << "/run/slurmctld.pid\nSlurmdPidFile=" << d << "/run/slurmd-%n.pid\n"
      << "SlurmctldLogFile=" << d << "/log/slurmctld.log\nSlurmdLogFile=" << d << "/log/slurmd-%n.log\n"
      << "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\nSwitchType=switch/none\n"
      << "JobAcctGatherType=jobacct_gather/none\nAccountingStorageType=accounting_storage/none\n"
      // One line an attempt, NODE_FAIL for the one that was requeued.
      << "JobCompType=jobcomp/filetxt\nJobCompLoc=" << d << "/log/jobcomp.txt\n"
      << "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\nSchedulerType=sched/backfill\n"
      << "SchedulerParameters=batch_sched_delay=0,sched_min_interval=100000,sched_interval=1,bf_interval=1\n"
      // Processors as declared here, not as the machine has them.
      << "SlurmdParameters=config_overrides\n"
      // JobRequeue=0: a task is requeued because its script requests it. ReturnToService=1: only state=resume brings a
      // node back that was set down. MinJobAge: ended jobs stay known.
      << "JobRequeue=0\nReturnToService=1\nSlurmdTimeout=10\nKillWait=2\nMinJobAge=3600\nMailProg=/bin/true\n"
      << "MaxArraySize=" << array_max_ << "\n";
  // Slurm 23 and newer look for cgroups even if no plugin uses them; older ones do not know this word.
  if (slurm_release() >= 23) std::ofstream(d + "/cgroup.conf") << "CgroupPlugin=disabled\n";
  for (int i = 0; i < nodes_; ++i) {
    fs::create_directories(home_ / "spool" / node_name(i));
    out << "NodeName=" << node_name(i) << " NodeHostname=localhost NodeAddr=127.0.0.1 Port=" << port_ + 1 + i
        << " CPUs=1 Sockets=1 CoresPerSocket=1 ThreadsPerCore=1 RealMemory=1000 State=UNKNOWN\n";
  }
  out << "PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n";
}

bool Cluster::start() {
  port_ = free_ports(1 + nodes_);
  write_settings();
  const fs::path munge = home_ / "munge";
  {
    std::random_device chance;
    std::ofstream key(munge / "key", std::ios::binary);
    for (int i = 0; i < 128; ++i) key.put(static_cast<char>(chance()));
  }
  fs::permissions(munge / "key", fs::perms(0600));
  fs::remove(munge / "sock");
  const auto file = [&](const char* flag, const char* name) { return flag + (munge / name).string(); };
  munged_ = start_daemon({"munged", "-F", file("--socket=", "sock"), file("--key-file=", "key"),
                          file("--pid-file=", "pid"), file("--log-file=", "log"), file("--seed-file=", "seed")},
                         environment(), home_ / "log/munged.out");
  if (!wait_until([&] { return fs::exists(munge / "sock"); }, kStart)) return false;
  controller_ = start_daemon({"slurmctld", "-D"}, environment(), home_ / "log/slurmctld.out");
  if (!wait_until([&] { return client({"scontrol", "ping"}).code == 0; }, kStart)) return false;
  for (int i = 0; i < nodes_; ++i) start_node(node_name(i));
  return wait_until(
      [&] {
        const auto idle = client({"sinfo", "-h", "-N", "-t", "idle", "-o", "%N"}).out;
        return std::count(idle.begin(), idle.end(), '\n') == nodes_;
      },
      kStart);
}

void Cluster::start_node(const std::string& node) {
  daemons_[node] =
      start_daemon({"slurmd", "-D", "-N", node}, environment(), home_ / "log" / ("slurmd-" + node + ".out"));
}

std::vector<std::string> Cluster::environment() const {
  return {path_setting(), "SLURM_CONF=" + (home_ / "slurm.conf").string()};
}

cli_test::Result Cluster::client(const std::vector<std::string>& words) const {
  std::vector<std::string> all{"timeout", "20"};
  all.insert(all.end(), words.begin(), words.end());
  cli_test::Surroundings here;
  here.folder = folder_.path();
  here.environment = environment();
  return cli_test::run_words(all, here);
}

std::string Cluster::say(const std::vector<std::string>& words) const {
  auto result = client(words);
  if (result.code != 0) throw std::runtime_error(words[0] + " failed: " + result.err + logs());
  if (result.out.ends_with('\n')) result.out.pop_back();
  return result.out;
}

std::vector<Job> Cluster::jobs(const std::string& id) const {
  std::vector<Job> found;
  std::istringstream lines(client({"scontrol", "show", "job", id, "-o"}).out);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("JobId=")) found.push_back(job_from(line));
  }
  return found;
}

bool Cluster::ended(const std::string& id) const {
  const auto all = jobs(id);
  for (const auto& job : all) {
    const auto& state = job.at("JobState");
    for (const char* on : {"PENDING", "RUNNING", "COMPLETING", "CONFIGURING", "REQUEUED", "SUSPENDED"})
      if (state == on) return false;
  }
  return !all.empty();
}

std::string Cluster::node_state(const std::string& node) const {
  return say({"sinfo", "-h", "-N", "-n", node, "-o", "%T"});
}

void Cluster::set_node(const std::string& node, const std::string& state) const {
  say({"scontrol", "update", "nodename=" + node, "state=" + state, "reason=test"});
}

void Cluster::crash(const std::string& node) {
  std::vector<pid_t> victims;
  for (const auto& process : processes_of(folder_.path())) {
    if (!process.has("SLURMD_NODENAME=" + node)) continue;
    victims.push_back(process.id);
    // The step's own process, which names no node.
    if (process.parent > 1 &&
        read_bytes("/proc/" + std::to_string(process.parent) + "/cmdline").starts_with("slurmstepd"))
      victims.push_back(process.parent);
  }
  ::kill(daemons_.at(node), SIGKILL);
  for (const pid_t victim : victims) ::kill(victim, SIGKILL);
  end_child(daemons_.at(node));
  daemons_.erase(node);
  set_node(node, "down");  // by itself the controller notices only after a minute
}

void Cluster::bring_back(const std::string& node) {
  start_node(node);
  set_node(node, "resume");
}

std::vector<std::string> Cluster::end() {
  ended_ = true;
  if (controller_ != 0) {
    client({"scancel", "--user=" + user_name()});
    // A step that still runs when its slurmd ends would be orphaned.
    wait_until([&] { return client({"squeue", "-h"}).out.empty(); }, 10);
  }
  for (const auto& [node, daemon] : daemons_) end_child(daemon);
  daemons_.clear();
  for (pid_t* daemon : {&controller_, &munged_}) {
    if (*daemon != 0) end_child(*daemon);
    *daemon = 0;
  }
  std::vector<std::string> left;
  wait_until([&] { return processes_of(folder_.path()).empty(); }, 3);
  for (const auto& process : processes_of(folder_.path())) {
    left.push_back(std::to_string(process.id) + " " + process.command);
    ::kill(process.id, SIGKILL);
  }
  return left;
}

std::string Cluster::logs() const {
  std::string text;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(home_ / "log", ignored))
    text += "--- " + entry.path().filename().string() + "\n" + tail(entry.path());
  return text + "--- munge\n" + tail(home_ / "munge/log");
}

}  // namespace fastsplat::slurm_test
