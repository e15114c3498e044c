// tests/program/low_limits_test.cpp: under low limits on threads, memory and files the program reports an error and
// leaves no files behind; it neither aborts nor hangs.
#include "engine/base/threads.h"
#include "tests/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

namespace sikku::low_limits_test {

bool can_run_as_nobody() {
    const std::string command = "setpriv --reuid=65534 --regid=65534 --clear-groups '" + std::string(SIKKU_PROGRAM) +
                                "' --version > /dev/null 2>&1";
    return ::geteuid() == 0 && std::system(command.c_str()) == 0;
}

class LowLimits : public ::testing::Test {
protected:
    LowLimits() { std::filesystem::permissions(folder_.path(), std::filesystem::perms::all); }

    /// The program in a shell with the limits `ulimit` sets, as user nobody if `as_nobody`: limits of threads do not
    /// bind root.
    Outcome limited(const std::string& limits, const std::vector<std::string>& arguments, bool as_nobody = false) {
        std::vector<std::string> words = {"-c", "ulimit " + limits + "; exec \"$0\" -q \"$@\"", SIKKU_PROGRAM};
        words.insert(words.end(), arguments.begin(), arguments.end());
        Surroundings there{.folder = folder_.path(), .program = "bash"};
        if (as_nobody) {
            const std::vector<std::string> other = {"--reuid=65534", "--regid=65534", "--clear-groups", "bash"};
            words.insert(words.begin(), other.begin(), other.end());
            there.program = "setpriv";
        }
        return run(words, there);
    }
    /// All is well, or there is a message and nothing but it.
    void expect_result_or_message(const Outcome& outcome, const std::string& file) {
        EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.status << ' ' << outcome.errors;
        if (outcome.status == 1) {
            EXPECT_FALSE(outcome.errors.empty());
        }
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
            EXPECT_FALSE(has(entry.path().filename().string(), ".tmp")) << entry.path();
        }
        EXPECT_EQ(std::filesystem::exists(folder_ / file), outcome.status == 0) << outcome.errors;
        std::filesystem::remove_all(folder_ / file);
    }

    ScratchFolder folder_;
};

TEST_F(LowLimits, OfThreads) {
    if (sanitized) GTEST_SKIP() << "the sanitizer starts threads of its own";
    if (!can_run_as_nobody()) GTEST_SKIP() << "only root can switch to a user that limits apply to";
    for (const char* limit : {"-u 1", "-u 2", "-u 6", "-u 12"}) {
        SCOPED_TRACE(limit);
        for (const char* name : {"x.png", "x.tif", "x.svg"}) {
            expect_result_or_message(limited(limit, {"draw", "hilbert", "-j", "4", "-o", name}, true), name);
        }
        expect_result_or_message(limited(limit, {"draw", "hilbert", "--generations", "1:3", "-o", "x.gif"}, true),
                                 "x.gif");
    }
    // OpenImageIO starts threads of its own.
    const Outcome refused = limited("-u 2", {"draw", "hilbert", "-j", "4", "-o", "x.tif"}, true);
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(has(refused.errors, "threads"));
    // Outputs that do not need it are made with the threads that can be started.
    EXPECT_EQ(limited("-u 1", {"gallery", "hilbert", "dragon", "-f", "svg,png", "-j", "4", "-o", "g"}, true).status,
              0);
    EXPECT_EQ(limited("-u 1", {"kolam", "--grid", "3x3", "--enumerate"}, true).status, 0);
    const Outcome gallery =
        limited("-u 3", {"gallery", "hilbert", "dragon", "-f", "svg,tif", "-j", "4", "-o", "h"}, true);
    EXPECT_EQ(gallery.status, 1);
    EXPECT_TRUE(has(gallery.errors, "threads"));
    expect_result_or_message(limited("-u 1", {"play", "hilbert", "-o", "x.mid"}, true), "x.mid");
}

TEST_F(LowLimits, OfMemory) {
    if (sanitized) GTEST_SKIP() << "the sanitizer takes terabytes of addresses";
    for (const char* limit : {"-v 200000", "-v 400000", "-v 600000", "-v 700000"}) {
        SCOPED_TRACE(limit);
        for (const char* name : {"x.png", "x.tif", "x.svg", "x.mid"}) {
            const bool is_score = std::string_view(name).ends_with(".mid");
            expect_result_or_message(limited(limit, {is_score ? "play" : "draw", "hilbert", "-o", name}), name);
        }
    }
    EXPECT_EQ(limited("-v 400000", {"draw", "hilbert", "-o", "x.tif"}).status, 1);
}

TEST_F(LowLimits, OfFiles) {
    if (sanitized) GTEST_SKIP() << "without descriptors the sanitizer takes every object for invalid";
    for (const char* limit : {"-n 5", "-n 8", "-n 12", "-f 1", "-f 8"}) {
        SCOPED_TRACE(limit);
        for (const char* name : {"x.png", "x.tif", "x.svg", "x.pdf", "x.gcode", "x.obj", "x.stl"}) {
            expect_result_or_message(limited(limit, {"draw", "hilbert", "-o", name}), name);
        }
        expect_result_or_message(limited(limit, {"play", "hilbert", "-o", "x.mid"}), "x.mid");
    }
    EXPECT_EQ(limited("-f 1", {"draw", "hilbert", "-o", "x.svg"}).status, 1);
}

/// What a gallery could not finish is finished by the next run.
TEST_F(LowLimits, OfFilesInGalleries) {
    if (sanitized) GTEST_SKIP() << "without descriptors the sanitizer takes every object for invalid";
    constexpr int not_started = 127;  // the libraries could not be opened
    const std::vector<std::string> gallery = {"gallery", "hilbert", "dragon-drums", "-f", "mid,svg,png,html",
                                              "-j",      "1"};
    for (int files = 4; files <= 16; ++files) {
        SCOPED_TRACE(files);
        std::vector<std::string> words = gallery;
        words.insert(words.end(), {"-o", fmt::format("g{}", files)});
        const Outcome limited_run = limited(fmt::format("-n {}", files), words);
        if (limited_run.status == not_started) {
            EXPECT_FALSE(std::filesystem::exists(folder_ / words.back()));
        } else {
            EXPECT_LE(limited_run.status, 1) << limited_run.errors;
        }
        const Outcome whole = limited("-n 1024", words);
        EXPECT_EQ(whole.status, 0) << whole.errors;
    }
}

TEST(StartableThreads, AreThoseAskedForWhereNothingLimitsThem) {
    EXPECT_EQ(startable_threads(0), 0);
    EXPECT_EQ(startable_threads(-1), 0);
    EXPECT_EQ(startable_threads(20), 20);
}

}  // namespace sikku::low_limits_test
