// ROS 1's compiled tf2, asked one by one: the third side of the scalar benchmark, and what
// a batch is held against. Reads a command a line from standard input, answers each with a
// line of numbers.
//
//   poses NUMBER…                       seven a pose: what samples are made of
//   make SAMPLES PARENT CHILD …         a world of so many samples a link; bytes a sample
//   ask KIND QUESTION…                  nanoseconds a question, and some of the answers
//   insert TIME STAMP POSE …            nanoseconds a sample of world -> turtle1; pose at TIME
//   chain FOLDER DEPTH                  a world read from the files `stamps` and `samples`
//   times FOLDER                        asks it for the file `times`, writes `answers`

#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>
#include <unistd.h>

namespace {

using Pose = std::array<double, 7>;

constexpr int64_t kSecond = 1000000000;
constexpr int64_t kPeriod = 10000000;
constexpr size_t kShown = 20;

std::unique_ptr<tf2::BufferCore> buffer;
std::vector<Pose> poses;
std::string source;

double now_ns()
{
  // The time this process was given: others work on the same cores.
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec * 1e9 + t.tv_nsec;
}

ros::Time moment(int64_t ns)
{
  return ros::Time(ns / kSecond, ns % kSecond);
}

geometry_msgs::TransformStamped message(
    const std::string& parent, const std::string& child, int64_t stamp, const double* pose)
{
  geometry_msgs::TransformStamped made;
  made.header.frame_id = parent;
  made.child_frame_id = child;
  made.header.stamp = moment(stamp);
  made.transform.translation.x = pose[0];
  made.transform.translation.y = pose[1];
  made.transform.translation.z = pose[2];
  made.transform.rotation.x = pose[3];
  made.transform.rotation.y = pose[4];
  made.transform.rotation.z = pose[5];
  made.transform.rotation.w = pose[6];
  return made;
}

Pose numbers(const geometry_msgs::TransformStamped& found)
{
  const auto& to = found.transform.translation;
  const auto& by = found.transform.rotation;
  return {to.x, to.y, to.z, by.x, by.y, by.z, by.w};
}

void print(const Pose& pose)
{
  for (double number : pose) std::printf(" %.17g", number);
}

size_t memory()
{
  size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

void make(std::istream& words)
{
  size_t samples;
  words >> samples;
  std::vector<std::pair<std::string, std::string>> links;
  for (std::string parent, child; words >> parent >> child;) links.emplace_back(parent, child);
  buffer.reset();
  const size_t before = memory();
  buffer = std::make_unique<tf2::BufferCore>(ros::Duration(1e6));
  for (size_t k = 0; k < samples; ++k) {
    for (size_t n = 0; n < links.size(); ++n) {
      const int64_t jitter = (k * 7919 + n * 104729) % 500 * 1000;
      const Pose& pose = poses[(k + 131 * n) % poses.size()];
      buffer->setTransform(
          message(links[n].first, links[n].second, kSecond + k * kPeriod + jitter, pose.data()),
          "benchmark");
    }
  }
  std::printf("%.1f", (memory() - before) / double(samples * links.size()));
}

struct Question
{
  std::string target, source, fixed;
  ros::Time time, source_time;
};

template <typename Answer>
void ask_each(const std::vector<Question>& questions, Answer answer)
{
  std::vector<decltype(answer(questions[0]))> answers;
  answers.reserve(questions.size());
  const double begun = now_ns();
  for (const Question& question : questions) answers.push_back(answer(question));
  std::printf("%.3f", (now_ns() - begun) / questions.size());
  for (size_t i = 0; i < answers.size() && i < kShown; ++i) {
    if constexpr (std::is_same_v<decltype(answer(questions[0])), bool>) {
      std::printf(" %d", int(answers[i]));
    } else {
      print(numbers(answers[i]));
    }
  }
}

void ask(std::istream& words)
{
  std::string kind;
  words >> kind;
  std::vector<Question> questions;
  int64_t time, other;
  for (Question one; words >> one.target;) {
    words >> time;
    one.time = moment(time);
    words >> one.source;
    if (kind == "full") {
      words >> other >> one.fixed;
      one.source_time = moment(other);
    }
    questions.push_back(one);
  }
  if (kind == "can") {
    ask_each(questions, [](const Question& q) {
      return buffer->canTransform(q.target, q.source, q.time);
    });
  } else if (kind == "full") {
    ask_each(questions, [](const Question& q) {
      return buffer->lookupTransform(q.target, q.time, q.source, q.source_time, q.fixed);
    });
  } else {
    ask_each(questions, [](const Question& q) {
      return buffer->lookupTransform(q.target, q.source, q.time);
    });
  }
}

void insert(std::istream& words)
{
  int64_t asked, stamp;
  words >> asked;
  std::vector<geometry_msgs::TransformStamped> samples;
  for (size_t pose; words >> stamp >> pose;)
    samples.push_back(message("world", "turtle1", stamp, poses[pose].data()));
  tf2::BufferCore fresh(ros::Duration(10));
  const double begun = now_ns();
  for (const auto& sample : samples) fresh.setTransform(sample, "benchmark");
  std::printf("%.3f", (now_ns() - begun) / samples.size());
  print(numbers(fresh.lookupTransform("world", "turtle1", moment(asked))));
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

void chain(std::istream& words)
{
  std::string folder;
  int depth;
  words >> folder >> depth;
  const auto stamps = read_all<int64_t>(folder + "/stamps");
  const auto samples = read_all<double>(folder + "/samples");
  const size_t k = stamps.size() / depth;
  buffer = std::make_unique<tf2::BufferCore>(ros::Duration(1e6));
  for (int link = 0; link < depth; ++link) {
    const std::string parent = "f" + std::to_string(link), child = "f" + std::to_string(link + 1);
    for (size_t i = link * k; i < (link + 1) * k; ++i)
      buffer->setTransform(message(parent, child, stamps[i], &samples[7 * i]), "benchmark");
  }
  source = "f" + std::to_string(depth);
  std::printf("0");
}

void times(std::istream& words)
{
  std::string folder;
  words >> folder;
  const auto moments = read_all<int64_t>(folder + "/times");
  std::vector<Pose> answers(moments.size());
  const std::string target = "f0";
  const double begun = now_ns();
  for (size_t i = 0; i < moments.size(); ++i)
    answers[i] = numbers(buffer->lookupTransform(target, source, moment(moments[i])));
  std::printf("%.3f", (now_ns() - begun) / moments.size());
  std::ofstream(folder + "/answers", std::ios::binary)
      .write(reinterpret_cast<const char*>(answers.data()), answers.size() * sizeof(Pose));
}

}  // namespace

int main()
{
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string command;
    words >> command;
    if (command == "poses") {
      for (Pose pose; words >> pose[0];) {
        for (size_t i = 1; i < 7; ++i) words >> pose[i];
        poses.push_back(pose);
      }
      std::printf("0");
    } else if (command == "make") {
      make(words);
    } else if (command == "ask") {
      ask(words);
    } else if (command == "insert") {
      insert(words);
    } else if (command == "chain") {
      chain(words);
    } else if (command == "times") {
      times(words);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  return 0;
}
