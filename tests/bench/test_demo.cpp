#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include <halfsilver/error.h>
#include "bench/modes/demo/demo.h"
#include "bench/modes/demo/report.h"
#include "contract/program.h"

namespace halfsilver::bench {
namespace {

DemoPoint pointOf(const std::vector<double>& milliseconds) {
  DemoPoint point;
  for (std::size_t i = 0; i < milliseconds.size(); ++i) {
    DemoFrame frame;
    frame.frame = static_cast<int>(i);
    frame.wallMilliseconds = milliseconds[i];
    frame.totalBytes = 1000 + i;
    point.frames.push_back(frame);
  }
  return point;
}

TEST(BenchDemo, SlowFramesAreThoseOverTwiceTheMedian) {
  const DemoSummary summary = summarize(pointOf({10, 10, 11, 12, 20, 50, 10, 10, 9, 10}));
  EXPECT_EQ(summary.median, 10);
  EXPECT_DOUBLE_EQ(summary.steady, 0.9);
  EXPECT_EQ(summary.growth, 9);
}

TEST(BenchDemo, TheFirstFramesOfALongRunDoNotCount) {
  std::vector<double> times(100, 10);
  times[3] = 900;
  EXPECT_EQ(summarize(pointOf(times)).steady, 1);
  EXPECT_EQ(summarize(pointOf(times)).growth, 49);
  times[60] = 900;
  EXPECT_DOUBLE_EQ(summarize(pointOf(times)).steady, 0.98);
}

TEST(BenchDemo, ALineThatIsNoFrameIsNamedInOneLine) {
  const std::string good = exactText(DemoFrame{.frame = 7, .coverage = 0.25, .times = {{"trace", 1.5}}}) + "\n";
  std::istringstream whole(good + good);
  const std::vector<DemoFrame> frames = readFrames(whole, "lines.json");
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].frame, 7);
  EXPECT_EQ(frames[1].coverage, 0.25);
  EXPECT_EQ(frames[1].times.at("trace"), 1.5);
  for (const std::string bad : {"{\"frame\": 1", "", "nonsense", "[]", "{}", "{\"frame\": \"one\"}"}) {
    std::istringstream stream(good + bad + "\n" + good);
    try {
      readFrames(stream, "lines.json");
      ADD_FAILURE() << bad << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::badInput);
      EXPECT_STREQ(error.what(), "lines.json, line 2: not the figures of a frame in JSON");
    }
  }
}

#if HALFSILVER_DEMO
TEST(BenchDemo, ChartsAReplayAndResumes) {
  const TemporaryFolder folder;
  std::ofstream(folder / "roll.txt")
      << "halfsilver-recording 1\nsteps-per-second 60\nseed 0\n2 0 0 0 0 1\n60 0 127 0 0 0\n";
  const std::string command = "demo roll.txt -o DIR --quick --size 64x36 --frames 3";
  const ProgramResult result = runProgramIn(folder, command);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const std::vector<std::string> files = filesIn(folder);
  for (const char* name : {"DIR/demo.csv", "DIR/demo.json", "DIR/index.html", "DIR/roll.txt-auto.png"})
    EXPECT_TRUE(std::binary_search(files.begin(), files.end(), name)) << name;
  const nlohmann::json record = readJson(folder / "DIR/demo.json");
  ASSERT_EQ(record["points"].size(), 1u);
  const nlohmann::json& frames = record["points"][0]["frames"];
  ASSERT_EQ(frames.size(), 3u);
  for (const nlohmann::json& frame : frames) {
    EXPECT_GT(frame["coverage"], 0);
    EXPECT_GT(frame["total_bytes"], 1e5);
    EXPECT_GT(frame["wall_ms"], 0);
  }
  const std::string csv = readText(folder / "DIR/demo.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  const std::string before = readText(folder / "DIR/demo.json");
  ASSERT_EQ(runProgramIn(folder, command).exitCode, 0);
  EXPECT_EQ(readText(folder / "DIR/demo.json"), before) << "what is kept is not measured again";
}

TEST(BenchDemo, ABadReplayIsRefusedAndNothingIsWritten) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.txt") << "no recording\n";
  EXPECT_EQ(runProgramIn(folder, "demo none.txt -o DIR --size 64x36").exitCode, 3);
  EXPECT_EQ(runProgramIn(folder, "demo bad.txt -o DIR --size 64x36").exitCode, 3);
  EXPECT_EQ(filesIn(folder), std::vector<std::string>{"bad.txt"});
}
#endif

}  // namespace
}  // namespace halfsilver::bench
