// tests/program/gallery_runs_test.cpp: several runs in one folder at the same time, and runs that are killed
// repeatedly.
#include "tests/gallery.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <csignal>
#include <list>
#include <set>

namespace sikku::gallery_runs_test {

namespace fs = std::filesystem;

bool holds(const fs::path& file, const std::string& text) {
    return contents(file).find(text) != std::string::npos;
}

class GalleryRunsTest : public GalleryTest {};

TEST_F(GalleryRunsTest, ASecondRunWaitsForTheFirst) {
    ASSERT_EQ(small("out").status, 0);
    const auto whole = tree(folder / "out");
    const int held = open(folder.file("out/gallery.jsonl").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(flock(held, LOCK_EX), 0);
    const std::vector<std::string> asked = {"gallery", "--file", "gallery.toml", "-o", "out"};
    {
        Child stopped(asked, {.folder = folder.path()});
        stopped.await_errors();
        stopped.send(SIGINT);
        const Outcome outcome = stopped.wait();
        EXPECT_EQ(outcome.status, 130);
        EXPECT_TRUE(has(outcome.errors, "another run is using 'out/gallery.jsonl'; waiting for it"));
    }
    Child child(asked, {.folder = folder.path()});
    child.await_errors();
    close(held);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(has(outcome.errors, "waiting for it"));
    EXPECT_TRUE(has(outcome.errors, "0 made, 27 up to date"));
    EXPECT_EQ(differences(whole, tree(folder / "out")), "");
}

TEST_F(GalleryRunsTest, WholeRunsAndShardsAtATime) {
    ASSERT_EQ(small("whole").status, 0);
    const auto whole = tree(folder / "whole");
    for (int round = 0; round < (sanitized ? 1 : 6); ++round) {
        std::list<Child> runs;
        for (const char* shard : {"", "1/3", "2/3", "", "3/3", ""}) {
            std::vector<std::string> asked = {"gallery", "--file", "gallery.toml", "-o", "out", "-j", "1"};
            if (*shard != '\0') asked.insert(asked.end(), {"--shard", shard});
            runs.emplace_back(asked, Surroundings{.folder = folder.path()});
        }
        for (Child& run : runs) {
            const Outcome outcome = run.wait();
            EXPECT_EQ(outcome.status, 0) << outcome.errors;
        }
        EXPECT_EQ(differences(whole, tree(folder / "out")), "");
        fs::remove_all(folder / "out");
    }
}

TEST_F(GalleryRunsTest, AKilledRunStartedAgainLeavesShardsAlone) {
    const std::vector<std::string> asked = {"gallery", "hilbert", "-n", "8", "-f", "png", "--size", "A1", "-j", "1"};
    const auto with = [&](std::initializer_list<std::string> more) {
        std::vector<std::string> all = asked;
        all.insert(all.end(), more);
        return all;
    };
    ASSERT_EQ(run(with({"-o", "whole"}), {.folder = folder.path()}).status, 0);
    {
        const Child killed(with({"-o", "out"}), {.folder = folder.path()});
        ASSERT_TRUE(await([&] { return has_temporary(folder / "out", "hilbert.png"); }));
        killed.send(SIGKILL);
    }
    EXPECT_TRUE(has_temporary(folder / "out", "hilbert.png")) << "of the killed run";
    Child shard(with({"-o", "out", "--shard", "1/1000"}), {.folder = folder.path()});
    ASSERT_TRUE(await([&] { return holds(folder / "out/gallery-1-of-1000.jsonl", "hilbert.png"); }));
    const Outcome outcome = run(with({"-o", "out"}), {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "0 made, 1 up to date")) << "never twice";
    const Outcome of_shard = shard.wait();
    EXPECT_EQ(of_shard.status, 0) << of_shard.errors;
    EXPECT_TRUE(has(of_shard.errors, "1 made"));
    EXPECT_EQ(differences(tree(folder / "whole"), tree(folder / "out")), "");
}

TEST_F(GalleryRunsTest, AShardWhoseFilesTheWholeHasLeavesNothing) {
    ASSERT_EQ(small("out").status, 0);
    const auto whole = tree(folder / "out");
    const Outcome shard = small("out", {"--shard", "2/3"});
    EXPECT_EQ(shard.status, 0);
    EXPECT_TRUE(has(shard.errors, "0 made"));
    EXPECT_EQ(differences(whole, tree(folder / "out")), "");
    // But its record stays where it says something else.
    folder.write("square.lsys", square_text + "stroke: 1mm #123\n");
    for (const char* part : {"1/3", "2/3", "3/3"}) ASSERT_EQ(small("out", {"--shard", part}).status, 0);
    EXPECT_TRUE(has(small("out").errors, "0 made, 27 up to date"));
}

TEST_F(GalleryRunsTest, RunsThatAreKilledAgainAndAgainGetOn) {
    const std::vector<std::string> asked = {"gallery", "hilbert", "koch-curve", "dragon", "-f", "png", "--size",
                                            "A1",      "-j",      "1",          "-n",     "7",  "-o",  "out"};
    for (const int signal : {SIGKILL, SIGTERM}) {
        fs::remove_all(folder / "out");
        std::set<std::string> begun;
        // None of these runs lives until its first file is finished.
        for (int round = 0; round < 3; ++round) {
            Child child(asked, {.folder = folder.path()});
            std::string now;
            ASSERT_TRUE(await([&] {
                for (const char* name : {"hilbert.png", "koch-curve.png", "dragon.png"}) {
                    if (!begun.contains(name) && has_temporary(folder / "out", name)) now = name;
                }
                return !now.empty();
            })) << "each run begins with another job";
            child.send(signal);
            if (signal != SIGKILL) {
                EXPECT_NE(child.wait().status, 0);
            }
            begun.insert(now);
        }
        EXPECT_EQ(begun.size(), 3U);
    }
    EXPECT_EQ(run(asked, {.folder = folder.path()}).status, 0);
    EXPECT_FALSE(holds(folder / "out/gallery.jsonl", "claim"));
    EXPECT_EQ(tree(folder / "out").size(), 5U) << "nothing is left";
}

}  // namespace sikku::gallery_runs_test
