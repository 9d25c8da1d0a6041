#include "cli/video.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "cli/programs.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failed(const std::string& path, const std::string& reason) {
  throw_input({.where = path,
               .what = "ffmpeg could not make the video: " + reason,
               .expected = {},
               .got = {},
               .fix = "the frames are there; run the command again to try only the video"});
}

std::string last_line(std::string text) {
  while (text.ends_with('\n')) text.pop_back();
  const auto begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

[[noreturn]] void become(const std::vector<std::string>& words, int errors) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // a signal to us alone must not leave it behind
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

/// What `words` say on stderr; their exit code in `code`.
std::string run_words(const std::vector<std::string>& words, const std::string& path, int& code) {
  std::array<int, 2> errors{};
  if (::pipe2(errors.data(), O_CLOEXEC) != 0) failed(path, std::strerror(errno));
  const pid_t child = ::fork();
  if (child < 0) failed(path, std::strerror(errno));
  if (child == 0) become(words, errors[1]);
  ::close(errors[1]);
  std::string said;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t got = ::read(errors[0], buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    said.append(buffer.data(), static_cast<std::size_t>(got));
  }
  ::close(errors[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return said;
}

}  // namespace

void check_video(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending != ".mp4" && ending != ".mkv" && ending != ".webm") {
    throw_usage({.where = path,
                 .what = "the ending does not name a video format",
                 .expected = ".mp4, .mkv, .webm",
                 .got = ending.empty() ? "none" : ending,
                 .fix = "end the name in .mp4"});
  }
  if (!in_path("ffmpeg")) {
    throw_input({.where = "--video",
                 .what = "ffmpeg is not installed",
                 .expected = {},
                 .got = {},
                 .fix = "apt-get install ffmpeg, or leave --video out and keep the frames"});
  }
}

void write_video(const Video& video) {
  AtomicFile file(video.path);
  // "file:" keeps a colon or a leading dash in a name from meaning anything; players want even sides and 4:2:0.
  const std::vector<std::string> words{"ffmpeg",
                                       "-nostdin",
                                       "-loglevel",
                                       "error",
                                       "-y",
                                       "-framerate",
                                       fmt::format("{}", video.rate),
                                       "-start_number",
                                       "0",
                                       "-i",
                                       "file:" + video.frames,
                                       "-frames:v",
                                       fmt::format("{}", video.count),
                                       "-vf",
                                       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                       "-pix_fmt",
                                       "yuv420p",
                                       "file:" + file.temporary().string()};
  int code = 0;
  const std::string said = run_words(words, video.path, code);
  if (code != 0) failed(video.path, said.empty() ? fmt::format("exit code {}", code) : last_line(said));
  file.commit();
}

}  // namespace fastsplat::cli
