// tests/program/studio_test.cpp: `sikku studio`, with a small page instead of the studio.
#include "art/link/link.h"
#include "tests/program.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <vector>

namespace sikku::studio_test {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::string before = "<!doctype html>\n<script type=\"application/json\" id=\"sikku-patterns\">";
const std::string after = "</script>\n<script>run()</script>\n";

/// An installation of the program in a folder, with a page or without.
class Studio : public ::testing::Test {
protected:
    Studio() {
        for (const char* name : {"bin", "share/sikku", "path", "cache", "work"})
            fs::create_directories(folder_ / name);
        std::error_code error;
        fs::create_hard_link(SIKKU_PROGRAM, folder_ / "bin/sikku", error);
        if (error) fs::copy_file(SIKKU_PROGRAM, folder_ / "bin/sikku");
        fs::create_directory_symlink(fs::path(SIKKU_SOURCE_DIR) / "patterns", folder_ / "share/sikku/patterns");
        set_page(before + "[]" + after);
    }

    void set_page(const std::string& text) { folder_.write("share/sikku/sikku-studio.html", text); }

    /// A program of that name that records its argument.
    void set_opener(const std::string& script) {
        const std::string file = folder_.write("path/xdg-open", "#!/bin/sh\n" + script);
        ::chmod(file.c_str(), 0755);
    }

    Outcome studio(std::vector<std::string> arguments, const std::string& display = "") {
        arguments.insert(arguments.begin(), "studio");
        return run(arguments, {.folder = folder_ / "work",
                               .environment = {{"DISPLAY", display},
                                               {"WAYLAND_DISPLAY", ""},
                                               {"PATH", folder_.file("path")},
                                               {"OPENED", folder_.file("opened")},
                                               {"XDG_CACHE_HOME", folder_.file("cache")}},
                               .program = folder_.file("bin/sikku")});
    }

    std::string address(const std::string& name) { return "file://" + folder_.file(name); }

    Json patterns_in(const fs::path& file) {
        const std::string text = contents(file);
        EXPECT_TRUE(text.starts_with(before) && text.ends_with(after)) << text;
        const std::string json = text.substr(before.size(), text.size() - before.size() - after.size());
        EXPECT_FALSE(has(json, "<"));
        return Json::parse(json);
    }

    ScratchFolder folder_;
    const std::string page_ = "share/sikku/sikku-studio.html";
};

TEST_F(Studio, ThePageIsPrintedWithoutADisplay) {
    const Outcome outcome = studio({});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, address(page_) + '\n');
    EXPECT_EQ(studio({}, ":0").output, outcome.output) << "nor without xdg-open";
}

TEST_F(Studio, APageThatIsMissingIsReported) {
    fs::remove(folder_ / page_);
    const Outcome outcome = studio({});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "./demo --studio"));
}

TEST_F(Studio, APatternIsInTheAddress) {
    const Outcome outcome = studio({"snake-kolam"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    ASSERT_TRUE(outcome.output.starts_with(address(page_) + "#sikku1."));
    const SharedWork work = read_link(outcome.output);
    EXPECT_EQ(work.name, "snake-kolam.lsys");
    EXPECT_EQ(work.text, contents(fs::path(SIKKU_SOURCE_DIR) / "patterns/kolams/snake-kolam.lsys"));
    // A link stays as it is.
    const std::string link = outcome.output.substr(outcome.output.find('#'), outcome.output.size() - 1);
    EXPECT_EQ(studio({link}).output, outcome.output);
}

TEST_F(Studio, LongPatternsAndSeveralAreInACopy) {
    std::string text = "axiom: F\n";
    for (int i = 0; i < 20'000; ++i) text += "// " + std::to_string(i * 7919 % 100'003) + "\n";
    folder_.write("work/long.lsys", text);
    const Outcome outcome = studio({"long.lsys"});
    EXPECT_EQ(outcome.output, address("cache/sikku/sikku-studio.html") + '\n') << outcome.errors;
    EXPECT_EQ(patterns_in(folder_ / "cache/sikku/sikku-studio.html"),
              Json::array({{{"name", "long.lsys"}, {"text", text}, {"variant", ""}, {"settings", Json::array()}}}));
    EXPECT_EQ(studio({"hilbert", "koch-island"}).output, outcome.output);
    EXPECT_EQ(patterns_in(folder_ / "cache/sikku/sikku-studio.html").size(), 2U);
}

TEST_F(Studio, ThePageIsWrittenWithPatterns) {
    const std::string text = "title: </script><!-- <script> \xE2\x80\xA8 \"\\\naxiom: F\n";
    folder_.write("work/my.lsys", text);
    SharedWork shared;
    shared.name = "shared.lsys";
    shared.text = "axiom: F\n";
    shared.settings = {{"seed", "7"}};
    shared.draw = {{"size", "A3"}};
    const Outcome outcome = studio({"my.lsys", "hilbert", link_of(shared), "-o", "out.html"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    const Json list = patterns_in(folder_ / "work/out.html");
    ASSERT_EQ(list.size(), 3U);
    EXPECT_EQ(list[0]["text"], text);
    EXPECT_EQ(list[1]["name"], "hilbert.lsys");
    EXPECT_EQ(list[2], (Json{{"name", "shared.lsys"},
                             {"text", "axiom: F\n"},
                             {"variant", ""},
                             {"settings", Json::array({Json::array({"seed", "7"})})},
                             {"draw", Json::array({Json::array({"size", "A3"})})}}));
    // The patterns of a page are replaced.
    set_page(contents(folder_ / "work/out.html"));
    EXPECT_EQ(studio({"-o", "empty.html"}).status, 0);
    EXPECT_EQ(contents(folder_ / "work/empty.html"), before + "[]" + after);
}

TEST_F(Studio, FaultsAreReported) {
    EXPECT_EQ(studio({"hilbert", "-o", "x.svg"}).status, 2);
    EXPECT_EQ(studio({"hilbertt"}).status, 2);
    EXPECT_EQ(studio({"sikku1.AAAA"}).status, 2);
    folder_.write("work/bad.lsys", "\xff\xff");
    const Outcome bad = studio({"bad.lsys"});
    EXPECT_EQ(bad.status, 2);
    EXPECT_TRUE(has(bad.errors, "UTF-8"));
    set_page("<html>");
    const Outcome other = studio({"hilbert", "-o", "x.html"});
    EXPECT_EQ(other.status, 1);
    EXPECT_TRUE(has(other.errors, "not a studio page"));
    EXPECT_FALSE(fs::exists(folder_ / "work/x.html"));
}

TEST_F(Studio, XdgOpenOpensIt) {
    set_opener("printf '%s' \"$1\" > \"$OPENED\"\n");
    const Outcome outcome = studio({}, ":0");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(contents(folder_ / "opened"), address(page_));
    EXPECT_EQ(studio({"hilbert"}, ":0").status, 0);
    EXPECT_EQ(contents(folder_ / "opened"), address("cache/sikku/sikku-studio.html"));
    EXPECT_EQ(patterns_in(folder_ / "cache/sikku/sikku-studio.html")[0]["name"], "hilbert.lsys");
    // The studio shows what a link contains before it runs it.
    SharedWork shared;
    shared.name = "a.lsys";
    shared.text = "axiom: F\n";
    EXPECT_EQ(studio({link_of(shared)}, ":0").status, 0);
    EXPECT_EQ(contents(folder_ / "opened"), address("cache/sikku/link.html"));
    EXPECT_TRUE(has(contents(folder_ / "cache/sikku/link.html"), "0;url=" + address(page_) + '#' + link_of(shared)));
    set_opener("exit 3\n");
    EXPECT_EQ(studio({}, ":0").output, address(page_) + '\n');
}

}  // namespace sikku::studio_test
