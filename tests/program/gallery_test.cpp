// tests/program/gallery_test.cpp: the outputs, resumption and errors of `sikku gallery`.
#include "tests/gallery.h"

#include <gtest/gtest.h>
#include <sys/mount.h>

#include <csignal>
#include <ctime>
#include <filesystem>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace sikku::gallery_test {

TEST_F(GalleryTest, MakesWhatTheFileSays) {
    const Outcome outcome = small("out");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    const auto files = tree(folder / "out");
    EXPECT_EQ(files.size(), small_count + 2);
    for (const char* name : {"square-n0.svg", "square-n3.png", "hilbert-n2-angle80.svg", "dragon-n5-angle90.png",
                             "hilbert-in-c-seed2.mid", "gallery.jsonl"}) {
        EXPECT_TRUE(files.contains(name)) << name;
    }
    EXPECT_EQ(lines_of(files.at("gallery.jsonl")), small_count + 1) << "the page, too";
    EXPECT_NE(files.at("hilbert-in-c-seed1.mid"), files.at("hilbert-in-c-seed2.mid"));
    // The same as the commands for one make.
    ASSERT_EQ(run({"-q", "draw", "square.lsys", "-n", "3", "--size", "50x50mm", "--dpi", "100", "-o", "x.png"},
                  {.folder = folder.path()})
                  .status,
              0);
    EXPECT_EQ(contents(folder / "x.png"), files.at("square-n3.png"));
}

TEST_F(GalleryTest, ListsAndReadsItsList) {
    const Outcome list = small("out", {"--list"});
    EXPECT_EQ(list.status, 0);
    EXPECT_EQ(lines_of(list.output), small_count);
    EXPECT_TRUE(has(list.output, "hilbert-n5-angle90.svg"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
    const Outcome json = small("out", {"--list", "--json"});
    folder.write("jobs.jsonl", json.output);
    const Outcome again = gallery({"--manifest", "jobs.jsonl", "--list", "--json"});
    EXPECT_EQ(again.output, json.output) << again.errors;
    ASSERT_EQ(small("one").status, 0);
    ASSERT_EQ(gallery({"--manifest", "jobs.jsonl", "-o", "two"}).status, 0);
    EXPECT_EQ(differences(tree(folder / "one"), tree(folder / "two")), "");
}

TEST_F(GalleryTest, ForecastsWithoutMakingAnything) {
    const Outcome outcome = gallery({"hilbert", "-n", "40:41", "--dry-run", "-o", "out", "--budget", "1e30"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.output, "4029752732048763915687251"));
    EXPECT_TRUE(has(outcome.output, "2 jobs"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_F(GalleryTest, NamesByTemplate) {
    folder.write("t.toml",
                 "name = '{kind}/{pattern}-{n}-{angle increment}'\n[[item]]\npattern = 'hilbert'\n[item.set]\n"
                 "heading = ['0', '90']\n'angle increment' = '60:62:1'\n");
    const Outcome list = gallery({"--file", "t.toml", "--list"});
    // `heading` is not in the name.
    EXPECT_EQ(list.status, 2);
    EXPECT_TRUE(has(list.errors, "t.toml:2:1: two jobs are named 'curves/hilbert-"));
    const Outcome named = gallery({"--file", "t.toml", "--list", "--name", "{heading}/{pattern}-{angle increment}"});
    EXPECT_EQ(named.status, 0) << named.errors;
    for (const char* name : {"0/hilbert-60.svg", "0/hilbert-62.svg", "90/hilbert-61.svg"}) {
        EXPECT_TRUE(has(named.output, name));
    }
    const Outcome own = gallery({"hilbert", "--list", "--name", "{pattern}-n{n}"});
    EXPECT_FALSE(has(own.output, "{"));
    EXPECT_FALSE(has(own.output, "-n.")) << "the pattern's own length: " << own.output;
}

TEST_F(GalleryTest, PatternsByGlobKindFolderAndFile) {
    EXPECT_TRUE(has(gallery({"koch*", "--list"}).output, "koch-island"));
    EXPECT_TRUE(has(gallery({"kolams/*", "--list"}).output, "snake-kolam"));
    EXPECT_EQ(gallery({"kolams", "--list"}).output, gallery({"kolams/*", "--list"}).output);
    std::filesystem::create_directories(folder / "mine/deep");
    folder.write("mine/a.lsys", square_text);
    folder.write("mine/deep/b.lsys", square_text);
    EXPECT_EQ(lines_of(gallery({"mine", "--list"}).output), 2U);
    EXPECT_EQ(lines_of(gallery({"mine/*.lsys", "--list"}).output), 1U);
    EXPECT_EQ(lines_of(gallery({"mine/a.lsys", "mine", "--list"}).output), 2U) << "each only once";
    EXPECT_GT(lines_of(gallery({"--list"}).output), 60U);
}

TEST_F(GalleryTest, MistakesHavePlaces) {
    const auto refused = [&](const std::string& text, std::string_view message) {
        folder.write("bad.toml", text);
        const Outcome outcome = gallery({"--file", "bad.toml", "-o", "out"});
        EXPECT_EQ(outcome.status, 2) << text;
        EXPECT_TRUE(has(outcome.errors, message)) << text;
        EXPECT_FALSE(std::filesystem::exists(folder / "out")) << text;
    };
    refused("dpi = 100\nanlge = 3\n", "bad.toml:2:1: unknown key 'anlge'; did you mean 'angle'?");
    refused("pattern = 'hilbert'\nset = { 'angle increment' = [60, 'x'] }\n", "bad.toml:2:9: ");
    refused("fit = true\nstep = '1mm'\npattern = 'hilbert'\n", "bad.toml:2:1: step: cannot be combined with 'fit'");
    folder.write("bad.jsonl", "{\"pattern\": \"hilbert\"}\n{\"pattern\": \"hilbert\", \"nn\": 3}\n");
    EXPECT_TRUE(has(gallery({"--manifest", "bad.jsonl"}).errors, "bad.jsonl:2:24: unknown key 'nn'"));
    EXPECT_EQ(gallery({"--file", "none.toml"}).status, 2);
    EXPECT_EQ(gallery({"hilbert", "--memory", "much"}).status, 2);
    EXPECT_EQ(gallery({"hilbert", "--only", "hilbrt"}).status, 2);
    EXPECT_EQ(gallery({"hilbert", "--shard", "3/2"}).status, 2);
}

TEST_F(GalleryTest, ResumesAndRedoesWhatChanged) {
    ASSERT_EQ(small("out").status, 0);
    const auto first = tree(folder / "out");
    const auto made_at = std::filesystem::last_write_time(folder / "out/hilbert-n2-angle80.svg");
    EXPECT_TRUE(has(small("out").errors, "0 made, 27 up to date"));
    EXPECT_EQ(differences(first, tree(folder / "out")), "");
    // One that is gone, one that was cut, one pattern that changed, one job asked for.
    std::filesystem::remove(folder / "out/dragon-n2-angle80.svg");
    std::filesystem::resize_file(folder / "out/dragon-n5-angle80.png", 10);
    EXPECT_TRUE(has(small("out").errors, "2 made"));
    EXPECT_EQ(differences(first, tree(folder / "out")), "");
    EXPECT_TRUE(has(small("out", {"--only", "square-n2"}).errors, "2 made"));
    EXPECT_EQ(differences(first, tree(folder / "out")), "");
    folder.write("square.lsys", square_text + "stroke: 1mm #123\n");
    EXPECT_TRUE(has(small("out").errors, "19 up to date"));
    EXPECT_EQ(std::filesystem::last_write_time(folder / "out/hilbert-n2-angle80.svg"), made_at);
    folder.write("square.lsys", square_text + "stroke: 1mm #456\n");
    EXPECT_TRUE(has(small("out").errors, "19 up to date")) << "files of the same size";
    folder.write("square.lsys", square_text);
    EXPECT_TRUE(has(small("out").errors, "8 made"));
    EXPECT_EQ(differences(first, tree(folder / "out")), "");
    EXPECT_TRUE(has(small("out", {"--force"}).errors, "27 made"));
}

TEST_F(GalleryTest, AKilledRunGoesOn) {
    ASSERT_EQ(small("whole").status, 0);
    const auto whole = tree(folder / "whole");
    // Half of them die at any moment, before the first job or after the last, too; the others as soon as the first
    // file is there. On a busy machine either may come too late.
    std::mt19937 chance(4);
    std::size_t unfinished = 0;
    for (int round = 0; round < 10 || (unfinished == 0 && round < 100); ++round) {
        const std::string out = "killed" + std::to_string(round);
        {
            const Child child({"gallery", "--file", "gallery.toml", "-o", out}, {.folder = folder.path()});
            if (round % 2 == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(chance() % (sanitized ? 1200 : 400)));
            } else {
                EXPECT_TRUE(await([&] { return std::filesystem::exists(folder / out / "gallery.jsonl"); }));
            }
            child.send(SIGKILL);
        }
        if (std::filesystem::exists(folder / out)) {
            const auto left = tree(folder / out);
            unfinished += left.size() < whole.size() || left.at("gallery.jsonl") != whole.at("gallery.jsonl") ? 1 : 0;
            for (const auto& [name, held] : left) {
                if (whole.contains(name) && !name.ends_with(".jsonl")) {
                    EXPECT_EQ(held, whole.at(name)) << "torn: " << name;
                }
            }
        }
        const Outcome outcome = small(out);
        ASSERT_EQ(outcome.status, 0) << outcome.errors;
        ASSERT_EQ(differences(whole, tree(folder / out)), "");
        std::filesystem::remove_all(folder / out);
    }
    EXPECT_GT(unfinished, 0U);
}

TEST_F(GalleryTest, TornLinesCountForNothing) {
    ASSERT_EQ(small("out").status, 0);
    const auto whole = tree(folder / "out");
    const std::string record = whole.at("gallery.jsonl");
    std::ofstream(folder / "out/gallery.jsonl") << record.substr(0, record.size() / 2);
    // Of files without a record only --force knows what to do.
    const Outcome outcome = small("out", {"--keep-going"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "was not made by this gallery"));
    EXPECT_EQ(small("out", {"--force"}).status, 0);
    EXPECT_EQ(differences(whole, tree(folder / "out")), "");
}

TEST_F(GalleryTest, ShardsAreDisjointCompleteAndEqual) {
    ASSERT_EQ(small("whole").status, 0);
    const auto whole = tree(folder / "whole");
    for (const int count : {1, 2, 3, 8}) {
        std::multiset<std::string> listed;
        const std::string out = "of" + std::to_string(count);
        for (int index = count; index >= 1; --index) {
            const std::string shard = std::to_string(index) + "/" + std::to_string(count);
            std::istringstream list(small(out, {"--list", "--shard", shard}).output);
            for (std::string line; std::getline(list, line);) listed.insert(line);
            ASSERT_EQ(small(out, {"--shard", shard}).status, 0);
        }
        EXPECT_EQ(listed.size(), small_count);
        EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()).size(), small_count);
        const auto parts = tree(folder / out);
        // The whole has a page, too.
        EXPECT_EQ(parts.size(), small_count + static_cast<std::size_t>(count) + (count == 1 ? 1 : 0));
        for (const auto& [name, held] : parts) {
            if (!name.ends_with(".jsonl")) {
                EXPECT_EQ(held, whole.at(name)) << name;
            }
        }
        // The whole has nothing left to do but to join the records.
        EXPECT_TRUE(has(small(out).errors, "0 made, 27 up to date"));
        EXPECT_EQ(differences(whole, tree(folder / out)), "");
    }
}

TEST_F(GalleryTest, ShardsOfBatchSystems) {
    const auto listed = [&](std::vector<std::pair<std::string, std::string>> environment,
                            std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"--file", "gallery.toml", "--list"});
        return gallery(std::move(more), std::move(environment)).output;
    };
    const std::string second = listed({}, {"--shard", "2/3"});
    EXPECT_EQ(listed({{"SLURM_ARRAY_TASK_ID", "8"},
                      {"SLURM_ARRAY_TASK_MIN", "7"},
                      {"SLURM_ARRAY_TASK_MAX", "9"},
                      {"SLURM_ARRAY_TASK_COUNT", "3"}}),
              second);
    EXPECT_EQ(listed({{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "3"}}), second);
    EXPECT_EQ(listed({{"JOB_COMPLETION_INDEX", "1"}, {"JOB_COMPLETIONS", "3"}}), second);
    EXPECT_EQ(listed({{"JOB_COMPLETION_INDEX", "1"}}, {"--shard", "/3"}), second);
    const Outcome lost = gallery({"hilbert", "--list"}, {{"JOB_COMPLETION_INDEX", "1"}});
    EXPECT_EQ(lost.status, 2);
    EXPECT_TRUE(has(lost.errors, "'shard', /N"));
}

TEST_F(GalleryTest, WritesAScriptForSlurm) {
    std::filesystem::create_directories(folder / "bin");
    folder.write("bin/sbatch", "#!/bin/sh\necho \"$@\" >> '" + folder.file("called") + "'\necho '17;cluster'\n");
    std::filesystem::permissions(folder / "bin/sbatch", std::filesystem::perms::all);
    const Outcome outcome = gallery({"--file", "gallery.toml", "-o", "out", "--slurm", "4", "--memory", "1G"},
                                    {{"PATH", folder.file("bin") + ":/usr/bin:/bin"}});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    const std::string called = contents(folder / "called");
    EXPECT_TRUE(has(called, "--requeue --mem=1024M --array=0-3"));
    EXPECT_TRUE(has(called, "--dependency=afterok:17 "));
    const std::string script = contents(folder / "out.sbatch");
    EXPECT_TRUE(has(script, "#SBATCH --requeue"));
    EXPECT_FALSE(has(script, "--slurm"));
    // As Slurm would.
    for (const char* task : {"0", "1", "2", "3"}) {
        EXPECT_EQ(run({folder.file("out.sbatch")}, {.environment = {{"SLURM_ARRAY_TASK_ID", task},
                                                                    {"SLURM_ARRAY_TASK_MIN", "0"},
                                                                    {"SLURM_ARRAY_TASK_COUNT", "4"}},
                                                    .program = "sh"})
                      .status,
                  0);
    }
    EXPECT_EQ(run({folder.file("out.sbatch")}, {.program = "sh"}).status, 0);
    ASSERT_EQ(small("whole").status, 0);
    EXPECT_EQ(differences(tree(folder / "whole"), tree(folder / "out")), "");
}

TEST_F(GalleryTest, OneFailsAmongGoodOnes) {
    folder.write("bad.lsys", "axiom F\n");
    const std::vector<std::string> asked = {"bad.lsys", "hilbert", "dragon", "koch-island", "-o", "out", "-j", "1"};
    const Outcome stopped = gallery(asked);
    EXPECT_EQ(stopped.status, 1);
    EXPECT_TRUE(has(stopped.errors, "sikku: bad.svg failed: "));
    std::vector<std::string> going = asked;
    going.push_back("--keep-going");
    const Outcome outcome = gallery(going);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "1 failed"));
    EXPECT_TRUE(has(outcome.errors, "bad.lsys:1:"));
    EXPECT_EQ(tree(folder / "out").size(), 5U) << "with a page of what is there";
    EXPECT_FALSE(has(contents(folder / "out/index.html"), "\"bad\""));
    folder.write("bad.lsys", "axiom: F\n");
    EXPECT_EQ(gallery(asked).status, 0);
    EXPECT_EQ(tree(folder / "out").size(), 6U) << "with a page";
}

TEST_F(GalleryTest, ForeignFilesStay) {
    std::filesystem::create_directories(folder / "out");
    folder.write("out/hilbert.svg", "mine");
    folder.write("out/note.txt", "mine, too");
    folder.write("out/.hilbert.svg.notes", "and this");
    const Outcome outcome = gallery({"hilbert", "dragon", "-o", "out", "--keep-going"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "'out/hilbert.svg' already exists and was not made by this gallery"));
    EXPECT_EQ(contents(folder / "out/hilbert.svg"), "mine");
    EXPECT_TRUE(std::filesystem::exists(folder / "out/dragon.svg"));
    EXPECT_EQ(gallery({"hilbert", "dragon", "-o", "out", "--force"}).status, 0);
    EXPECT_NE(contents(folder / "out/hilbert.svg"), "mine");
    EXPECT_EQ(contents(folder / "out/note.txt"), "mine, too");
    EXPECT_EQ(contents(folder / "out/.hilbert.svg.notes"), "and this");
}

TEST_F(GalleryTest, MakesAPageAndSheets) {
    const std::vector<std::string> command = {"-q", "gallery",  "kolams", "-o",        folder.file("wall"),
                                              "-f", "svg,png",  "--size", "40x40mm",   "--dpi",
                                              "50", "--poster", "A5",     "--contact", "A6"};
    ASSERT_EQ(run(command).status, 0);
    const auto first = tree(folder.file("wall"));
    for (const char* name : {"index.html", "poster.svg", "poster.pdf", "poster.png", "contact.svg", "contact.pdf",
                             "contact.png", "snake-kolam.svg", "snake-kolam.png"}) {
        EXPECT_TRUE(first.contains(name)) << name;
    }
    const std::string& page = first.at("index.html");
    for (const char* name : {"snake-kolam", "anklets-of-krishna", "bag-of-candies", "mango-leaves"}) {
        EXPECT_TRUE(has(page, name)) << name;
    }
    EXPECT_TRUE(has(page, "<h1>Kolams</h1>"));
    // Again: nothing is made anew, and all is the same.
    const auto made_at = std::filesystem::last_write_time(folder / "wall/poster.svg");
    ASSERT_EQ(run(command).status, 0);
    EXPECT_EQ(differences(first, tree(folder.file("wall"))), "");
    EXPECT_EQ(std::filesystem::last_write_time(folder / "wall/poster.svg"), made_at);
    // What was cut is.
    std::filesystem::resize_file(folder / "wall/contact.png", 10);
    ASSERT_EQ(run(command).status, 0);
    EXPECT_EQ(differences(first, tree(folder.file("wall"))), "");
    // A page of others is not ours to replace.
    folder.write("wall/index.html", "<p>mine</p>");
    const Outcome refused = run(command);
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(has(refused.errors, "index.html' already exists and was not made by this gallery"));
    EXPECT_EQ(contents(folder.file("wall/index.html")), "<p>mine</p>");
}

TEST_F(GalleryTest, PostersThatComeAlong) {
    for (const char* name :
         {"figure-2.2", "figure-2.5", "figure-3.5", "figure-3.9", "figure-3.10", "figure-4.4", "figure-4.5",
          "figure-6.7", "figure-6.8", "figure-1.3", "figure-1.4", "figure-3.12", "figure-3.14", "csiro-figure-9",
          "csiro-figure-12", "csiro-figure-14", "csiro-figure-15", "csiro-figure-17"}) {
        const Outcome outcome = gallery({"--file", name, "-o", name});
        ASSERT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_TRUE(tree(folder.file(name)).contains("poster.pdf"));
    }
    folder.write("sheet.toml", "poster = 3\n");
    const Outcome bad = gallery({"--file", "sheet.toml", "-o", "x"});
    EXPECT_EQ(bad.status, 2);
}

TEST_F(GalleryTest, GenerationsStandInRows) {
    ASSERT_EQ(run({"-q", "gallery", "koch-island", "koch-curve", "-o", folder.file("rows"), "--generations", "0:3",
                   "-f", "svg", "--size", "40x40mm", "--poster", "A5"})
                  .status,
              0);
    const auto files = tree(folder.file("rows"));
    std::size_t prints = 0;
    for (const auto& [name, held] : files) prints += name.starts_with("koch-") ? 1 : 0;
    EXPECT_EQ(prints, 8u);
    EXPECT_TRUE(files.contains("poster.svg"));
}

TEST_F(GalleryTest, AFolderThatCannotBeWritten) {
    folder.write("file", "");
    const Outcome outcome = gallery({"hilbert", "-o", "file"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "cannot write 'file"));
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    std::filesystem::create_directories(folder / "closed");
    std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_read);
    EXPECT_EQ(gallery({"hilbert", "-o", "closed"}).status, 1);
}

TEST_F(GalleryTest, AFullDisk) {
    std::filesystem::create_directories(folder / "disk");
    if (mount("none", folder.file("disk").c_str(), "tmpfs", 0, "size=48k") != 0) GTEST_SKIP() << "nothing to mount";
    const Outcome full = small("disk");
    const auto left = tree(folder / "disk");
    const bool more = mount("none", folder.file("disk").c_str(), "tmpfs", MS_REMOUNT, "size=4m") == 0;
    const Outcome again = small("disk");
    const auto after = tree(folder / "disk");
    umount(folder.file("disk").c_str());
    EXPECT_EQ(full.status, 1);
    EXPECT_TRUE(has(full.errors, "No space left on device"));
    ASSERT_EQ(small("whole").status, 0);
    const auto whole = tree(folder / "whole");
    for (const auto& [name, held] : left) {
        if (!name.ends_with(".jsonl")) {
            EXPECT_EQ(held, whole.at(name)) << name;
        }
    }
    if (!more) return;
    EXPECT_EQ(again.status, 0) << again.errors;
    EXPECT_EQ(differences(whole, after), "");
}

TEST_F(GalleryTest, StopsTidilyAndGoesOn) {
    ASSERT_EQ(gallery({"hilbert", "-n", "3:8", "-f", "png", "--size", "150x150mm", "-o", "whole"}).status, 0);
    {
        Child child({"gallery", "hilbert", "-n", "3:8", "-f", "png", "--size", "150x150mm", "-o", "out"},
                    {.folder = folder.path()});
        child.await_handler(SIGTERM);
        child.send(SIGTERM);
        const Outcome outcome = child.wait();
        if (outcome.status != 0) {
            EXPECT_EQ(outcome.status, 143);
            EXPECT_TRUE(has(outcome.errors, "sikku: interrupted"));
        }
    }
    for (const auto& [name, held] : tree(folder / "out")) EXPECT_FALSE(name.ends_with(".tmp")) << name;
    ASSERT_EQ(gallery({"hilbert", "-n", "3:8", "-f", "png", "--size", "150x150mm", "-o", "out"}).status, 0);
    EXPECT_EQ(differences(tree(folder / "whole"), tree(folder / "out")), "");
}

TEST_F(GalleryTest, NothingDependsOnTheClockOrOnThreads) {
    ASSERT_EQ(small("one", {"-j", "1"}).status, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    ASSERT_EQ(small("two", {"-j", "5"}).status, 0);
    EXPECT_EQ(differences(tree(folder / "one"), tree(folder / "two")), "");
    // A clock that went back: what is there is from the future.
    for (const auto& entry : std::filesystem::directory_iterator(folder / "one")) {
        std::filesystem::last_write_time(entry.path(),
                                         std::filesystem::file_time_type::clock::now() + std::chrono::hours(1000));
    }
    EXPECT_TRUE(has(small("one").errors, "0 made"));
}

TEST_F(GalleryTest, MemoryStaysWithinItsBudget) {
    const Outcome refused = gallery({"hilbert", "-f", "png", "--size", "A0", "--memory", "1M", "-o", "out"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(has(refused.errors, "of memory, more than is available"));
    if (sanitized) GTEST_SKIP() << "sanitizers need additional memory";
    const Outcome outcome = gallery({"snake-kolam", "dragon", "hilbert", "gosper*", "-f", "png", "--size", "A1",
                                     "--memory", "300M", "-o", "out"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_LT(outcome.peak, 330 * 1024);
}

TEST_F(GalleryTest, SheetsStayWithinTheMemory) {
    const auto sheet = [&](const std::string& memory, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"hilbert", "dragon", "--size", "50x50mm", "--poster", "2000x2000mm", "--memory",
                                   memory, "-o", "out", "--force"});
        return gallery(more);
    };
    EXPECT_TRUE(has(sheet("8G", {"--dry-run"}).output, "poster.png"));
    const Outcome too_little = sheet("1M", {"--dry-run"});
    EXPECT_EQ(too_little.status, 1);
    EXPECT_TRUE(has(too_little.output, "poster.png                               it needs about"));
    if (sanitized) GTEST_SKIP() << "sanitizers need additional memory";
    ASSERT_EQ(sheet("8G").status, 0);
    const std::string whole = contents(folder / "out/poster.png");
    // All of its pixels are 186 MB.
    const Outcome outcome = sheet("180M");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_LT(outcome.peak, 180 * 1024);
    EXPECT_TRUE(contents(folder / "out/poster.png") == whole);
}

TEST_F(GalleryTest, AShardMayFinishWhileTheWholeIsMade) {
    std::filesystem::create_directories(folder / "out");
    // One that has begun.
    folder.write("out/gallery-1-of-2.jsonl", "{\"claim\":\"dragon.svg\"}\n");
    Child whole({"gallery", "snake-kolam", "hilbert", "-n", "4", "-f", "png", "--size", "A1", "-o", "out"},
                {.folder = folder.path()});
    whole.await_handler(SIGTERM);
    ASSERT_EQ(gallery({"dragon", "koch-curve", "-o", "out", "--shard", "1/2"}).status, 0);
    ASSERT_EQ(gallery({"dragon", "koch-curve", "-o", "out", "--shard", "2/2"}).status, 0);
    EXPECT_EQ(whole.wait().status, 0);
    const auto names = tree(folder / "out");
    EXPECT_FALSE(names.contains("gallery-1-of-2.jsonl"));
    EXPECT_TRUE(has(gallery({"dragon", "koch-curve", "-o", "out"}).errors, "0 made, 2 up to date"));
}

TEST_F(GalleryTest, ClaimsOfKilledRunsAreKept) {
    ASSERT_EQ(gallery({"hilbert", "dragon", "-o", "out"}).status, 0);
    std::string record = contents(folder / "out/gallery.jsonl");
    // As of a run that was killed between a file and its record; of two shards, likewise.
    record.replace(0, record.find('\n'), "{\"claim\":\"hilbert.svg\"}");
    folder.write("out/gallery.jsonl", record);
    folder.write("out/koch-curve.svg", "torn");
    folder.write("out/gallery-2-of-3.jsonl", "{\"claim\":\"koch-curve.svg\"}\n{\"claim\":\"snake-kolam.svg\"}\n");
    folder.write("out/.snake-kolam.svg.abcdef.tmp", "torn");
    folder.write("out/.snake-kolam.svg.notes", "mine");
    EXPECT_EQ(gallery({"hilbert", "dragon", "-o", "out", "--only", "dragon"}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/gallery-2-of-3.jsonl"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/.snake-kolam.svg.abcdef.tmp"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/.snake-kolam.svg.notes"));
    const Outcome again = gallery({"hilbert", "dragon", "koch-curve", "-o", "out"});
    EXPECT_EQ(again.status, 0) << again.errors;
    EXPECT_FALSE(has(contents(folder / "out/gallery.jsonl"), "claim"));
}

TEST_F(GalleryTest, UnfinishedPartsOfLostRecordsAreRemoved) {
    std::filesystem::create_directories(folder / "out");
    // As of a killed run whose record lost lines: nothing names the part, or the file itself.
    folder.write("out/.hilbert.svg.abcdef.tmp", "torn");
    folder.write("out/.dragon.svg.abcdef.tmp", "torn");
    folder.write("out/.koch-curve.svg.abcdef.tmp", "mine");
    folder.write("out/dragon.svg", "torn");
    folder.write("out/gallery.jsonl", "{\"claim\":\"koch.svg\"}\n{\"file\":\"dragon.svg\",\"ha\x01\n");
    EXPECT_EQ(gallery({"hilbert", "dragon", "-o", "out"}).status, 1);
    EXPECT_EQ(contents(folder / "out/dragon.svg"), "torn");
    const Outcome forced = gallery({"hilbert", "dragon", "-o", "out", "--force"});
    EXPECT_EQ(forced.status, 0) << forced.errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "out/.hilbert.svg.abcdef.tmp"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out/.dragon.svg.abcdef.tmp"));
    EXPECT_EQ(contents(folder / "out/.koch-curve.svg.abcdef.tmp"), "mine");
    const std::string record = contents(folder / "out/gallery.jsonl");
    EXPECT_EQ(record.find("\"claim\":\"dragon.svg\""), std::string::npos) << record;
    EXPECT_EQ(gallery({"hilbert", "dragon", "-o", "out"}).status, 0);
    EXPECT_EQ(contents(folder / "out/gallery.jsonl"), record);
}

TEST_F(GalleryTest, RecordsOfOthersStay) {
    const auto hold = [&](const std::string& name, const std::string& text, std::vector<std::string> more,
                          int status) {
        std::filesystem::remove_all(folder / "out");
        std::filesystem::create_directories(folder / "out");
        folder.write("out/" + name, text);
        more.insert(more.begin(), {"hilbert", "-o", "out"});
        const Outcome outcome = gallery(more);
        EXPECT_EQ(outcome.status, status) << name << outcome.errors;
        EXPECT_EQ(contents(folder / ("out/" + name)), text) << name;
    };
    hold("gallery.jsonl", "notes\n", {}, 1);
    hold("gallery-empty.jsonl", "", {}, 0);
    hold("gallery-1-of-2.jsonl", "notes\n", {}, 0);
    hold("index.html", "<p>This is not by Sikku</p>", {}, 1);
    hold("poster.svg", "<svg/>", {"--poster", "A5"}, 1);
    std::filesystem::remove_all(folder / "out");
    std::filesystem::create_directories(folder / "out");
    folder.write("out/gallery.jsonl", "{\"pattern\":\"hilbert\"}\n");
    EXPECT_EQ(gallery({"--manifest", "out/gallery.jsonl", "-o", "out"}).status, 1);
    EXPECT_EQ(contents(folder / "out/gallery.jsonl"), "{\"pattern\":\"hilbert\"}\n");
    // Links are replaced, not followed.
    folder.write("precious.svg", "mine");
    std::filesystem::remove_all(folder / "out");
    std::filesystem::create_directories(folder / "out");
    std::filesystem::create_symlink("../precious.svg", folder / "out/hilbert.svg");
    EXPECT_EQ(gallery({"hilbert", "-o", "out"}).status, 1);
    EXPECT_EQ(gallery({"hilbert", "-o", "out", "--force"}).status, 0);
    EXPECT_EQ(contents(folder / "precious.svg"), "mine");
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "out/hilbert.svg"));
    // Records do not lead out of the folder.
    folder.write(".outside.abcdef.tmp", "mine");
    std::ofstream(folder / "out/gallery.jsonl", std::ios::app) << "{\"claim\":\"../outside\"}\n";
    EXPECT_EQ(gallery({"hilbert", "-o", "out"}).status, 0);
    EXPECT_EQ(contents(folder / ".outside.abcdef.tmp"), "mine");
    folder.write("wall.sbatch", "mine");
    EXPECT_EQ(gallery({"hilbert", "-o", "wall", "--slurm", "2"}).status, 1);
    EXPECT_EQ(contents(folder / "wall.sbatch"), "mine");
}

TEST_F(GalleryTest, RecordsOfDeepBracketsAreSkipped) {
    std::filesystem::create_directories(folder / "out");
    folder.write("out/gallery.jsonl", "{\"file\":\"a.svg\",\"hash\":\"\",\"bytes\":1,\"content\":\"\",\"job\":" +
                                          std::string(200'000, '[') + std::string(200'000, ']') + "}\n");
    EXPECT_EQ(gallery({"hilbert", "-o", "out"}).status, 0);
}

TEST_F(GalleryTest, MistakesInValuesAreReported) {
    EXPECT_TRUE(has(gallery({"hilbert", "--contact", "3x", "-o", "out"}).errors, "contact 3x"));
    EXPECT_TRUE(has(gallery({"hilbert", "-n", "5:1"}).errors, "n: the range 5:1 is empty"));
    const Outcome poster = gallery({"hilbert", "-f", "mid", "--poster", "A3", "-o", "scores"});
    EXPECT_EQ(poster.status, 2);
    EXPECT_TRUE(has(poster.errors, "poster A3: this gallery has no prints for a sheet"));
    EXPECT_FALSE(std::filesystem::exists(folder / "scores"));
    EXPECT_EQ(gallery({"hilbert", "--json"}).status, 2);
    EXPECT_EQ(gallery({"hilbert", "--name", "\xFFx", "--list"}).status, 2);
    // Not mistakes.
    const auto listed = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "hilbert");
        arguments.push_back("--list");
        return lines_of(gallery(std::move(arguments)).output);
    };
    EXPECT_EQ(listed({"--set", "title=1:3"}), 1U);
    folder.write("good.toml", "pattern = 'hilbert'\nangle = ['60:70:5', 90]\nstep = '1mm'\n");
    EXPECT_EQ(lines_of(gallery({"--file", "good.toml", "--list"}).output), 4U);
    EXPECT_EQ(gallery({"--file", "good.toml", "--list", "--fit"}).status, 0);
}

TEST_F(GalleryTest, FoldersThatAreCalledAsOthers) {
    // The folder of the gallery shadows no kind.
    ASSERT_EQ(gallery({"kolams", "-o", "kolams", "--size", "30x30mm"}).status, 0);
    EXPECT_EQ(gallery({"kolams", "-o", "kolams", "--size", "30x30mm"}).status, 0);
    std::filesystem::create_directories(folder / "a[b]*");
    folder.write("a[b]*/x.lsys", square_text);
    folder.write("a[b]*/y[1].lsys", square_text);
    EXPECT_EQ(lines_of(gallery({"a[b]*", "--list"}).output), 2U);
    EXPECT_EQ(lines_of(gallery({"a[b]*/y[1].lsys", "--list"}).output), 1U);
    folder.write("a[b]*/g.toml", "pattern = '*.lsys'\n");
    EXPECT_EQ(lines_of(gallery({"--file", "a[b]*/g.toml", "--list"}).output), 2U);
}

TEST_F(GalleryTest, ASheetThatCannotBeMadeStopsNoOther) {
    const Outcome outcome = gallery(
        {"hilbert", "-n", "15", "-f", "png", "--size", "30x30mm", "--dpi", "100", "--poster", "A6", "-o", "out"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "poster.svg failed: 'Hilbert curve'"));
    const auto files = tree(folder / "out");
    EXPECT_TRUE(files.contains("index.html"));
    EXPECT_TRUE(files.contains("poster.png"));
    EXPECT_FALSE(files.contains("poster.svg"));
    // Windows are seen in all.
    EXPECT_EQ(
        gallery({"hilbert", "-n", "30", "--window", "0,0,20,20", "--size", "30x30mm", "--poster", "A6", "-o", "w"})
            .status,
        0);
}

TEST_F(GalleryTest, CardsTellWhatWasSet) {
    ASSERT_EQ(
        gallery({"hilbert", "--set", "heading=0:90:90", "--rotate", "45", "--size", "30x30mm", "-o", "out"}).status,
        0);
    const std::string page = contents(folder / "out/index.html");
    EXPECT_TRUE(has(page, "\"settings\":\"heading = 90, rotate = 45, size = 30x30mm\""));
}

TEST_F(GalleryTest, ForecastsTellWhatWillFail) {
    const Outcome large = gallery({"hilbert", "-n", "40", "--dry-run"});
    EXPECT_EQ(large.status, 1);
    EXPECT_TRUE(has(large.output, "above the budget"));
    EXPECT_TRUE(has(large.output, "1 job cannot be made"));
    EXPECT_EQ(gallery({"hilbert", "-f", "png", "--size", "A0", "--memory", "1M", "--dry-run"}).status, 1);
    // Words that only deriving measures may be refused, or not.
    folder.write("grows.lsys", "axiom: A(1)\nderivation length: 100\nA(x) : x<1e9 --> F(x)A(x*1.000001)[+A(x/3)]\n");
    const Outcome grows = gallery({"grows.lsys", "--dry-run"});
    EXPECT_EQ(grows.status, 0) << grows.errors;
    EXPECT_TRUE(has(grows.output, "may be refused"));
    EXPECT_FALSE(has(gallery({"hilbert", "--dry-run"}).output, "may be refused"));
}

}  // namespace sikku::gallery_test
