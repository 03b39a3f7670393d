"""ROS 1's compiled tf2, asked one by one from C++: what a batch is held against.

Needs Debian's libtf2-dev and a C++ compiler; says so where they are missing.
"""

import functools
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

SOURCE = r"""
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

namespace {

double now_ns()
{
  // The time this process was given: others work on the same cores.
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec * 1e9 + t.tv_nsec;
}

template <typename T>
std::vector<T> read_all(const std::string& path)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<T> values(file.tellg() / sizeof(T));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(values.data()), values.size() * sizeof(T));
  return values;
}

ros::Time moment(int64_t ns)
{
  return ros::Time(ns / 1000000000, ns % 1000000000);
}

}  // namespace

// stamps (depth, k) int64, samples (depth, k, 7), times (n) int64 -> answers (n, 7)
int main(int argc, char** argv)
{
  const std::string folder = argv[1];
  const int depth = std::atoi(argv[2]);
  const int rounds = std::atoi(argv[3]);
  const auto stamps = read_all<int64_t>(folder + "/stamps");
  const auto samples = read_all<double>(folder + "/samples");
  const auto times = read_all<int64_t>(folder + "/times");
  const size_t k = stamps.size() / depth;

  tf2::BufferCore buffer(ros::Duration(1e6));
  for (int link = 0; link < depth; ++link) {
    geometry_msgs::TransformStamped message;
    message.header.frame_id = "f" + std::to_string(link);
    message.child_frame_id = "f" + std::to_string(link + 1);
    for (size_t i = 0; i < k; ++i) {
      const double* s = &samples[7 * (link * k + i)];
      message.header.stamp = moment(stamps[link * k + i]);
      message.transform.translation.x = s[0];
      message.transform.translation.y = s[1];
      message.transform.translation.z = s[2];
      message.transform.rotation.x = s[3];
      message.transform.rotation.y = s[4];
      message.transform.rotation.z = s[5];
      message.transform.rotation.w = s[6];
      buffer.setTransform(message, "benchmark", false);
    }
  }

  const std::string target = "f0", source = "f" + std::to_string(depth);
  std::vector<double> answers(7 * times.size());
  for (int round = 0; round < rounds; ++round) {
    const double begun = now_ns();
    for (size_t i = 0; i < times.size(); ++i) {
      const auto found = buffer.lookupTransform(target, source, moment(times[i])).transform;
      double* a = &answers[7 * i];
      a[0] = found.translation.x;
      a[1] = found.translation.y;
      a[2] = found.translation.z;
      a[3] = found.rotation.x;
      a[4] = found.rotation.y;
      a[5] = found.rotation.z;
      a[6] = found.rotation.w;
    }
    std::printf("%.3f\n", (now_ns() - begun) / times.size());
  }
  std::ofstream(folder + "/answers", std::ios::binary)
      .write(reinterpret_cast<const char*>(answers.data()), answers.size() * sizeof(double));
  return 0;
}
"""


@functools.cache
def program() -> Path | str:
    """The compiled program, or why there is none."""
    compiler = shutil.which("g++") or shutil.which("clang++")
    if compiler is None:
        return "no C++ compiler"
    if not Path("/usr/include/tf2/buffer_core.h").exists():
        return "libtf2-dev is not installed"
    folder = Path(tempfile.mkdtemp(prefix="tftool-noetic-"))
    source, built = folder / "single.cpp", folder / "single"
    source.write_text(SOURCE)
    done = subprocess.run(
        [compiler, "-O3", "-o", built, source, "-ltf2", "-lrostime"],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        return f"does not compile here: {done.stderr.splitlines()[0]}"
    return built


def lookups(
    stamps: np.ndarray, samples: np.ndarray, times: np.ndarray, rounds: int = 1
) -> tuple[list[float], np.ndarray]:
    """Nanoseconds a lookup in each round, of processor time, and the answers, shape (n, 7).

    Args:
        stamps: Of each link of the chain f0 ← f1 ← …, shape (depth, k).
        samples: Their poses, shape (depth, k, 7).
        times: When f0 ← f(depth) is asked for, shape (n,).
        rounds: How often.
    """
    built = program()
    assert isinstance(built, Path), built
    with tempfile.TemporaryDirectory() as folder:
        for name, values in (("stamps", stamps), ("samples", samples), ("times", times)):
            values.tofile(Path(folder, name))
        done = subprocess.run(
            [built, folder, str(len(stamps)), str(rounds)],
            capture_output=True,
            text=True,
            check=True,
        )
        answers = np.fromfile(Path(folder, "answers")).reshape(-1, 7)
    return [float(line) for line in done.stdout.split()], answers
