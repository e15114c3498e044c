// tests/art/gallery_publisher_test.cpp: files of a gallery that are published in groups.
#include "art/gallery/publisher.h"

#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sikku::gallery_publisher_test {

/// A file in a gallery that contains its own name.
MadeFile made_file(GalleryRecord& record, const GalleryFolder& folder, const std::string& name) {
    FinishedJob job;
    job.file = name;
    job.hash = "hash";
    job.job = "{}";
    return make_gallery_file(record, folder, std::move(job), false,
                             [&](const std::filesystem::path& path, Destination& destination, FinishedJob&) {
                                 const auto file = destination.open(path);
                                 file->write(name);
                                 file->commit();
                             });
}

TEST(Publisher, PublishesWhatSeveralThreadsMake) {
    const ScratchFolder scratch;
    const GalleryFolder folder(scratch.path());
    GalleryRecord record(folder, "gallery.jsonl", false, [] {});
    constexpr int threads = 3, files = 150;
    std::mutex mutex;
    std::map<std::string, std::string> done;
    {
        Publisher publisher(record);
        std::vector<std::thread> makers;
        for (int thread = 0; thread < threads; ++thread) {
            makers.emplace_back([&, thread] {
                for (int i = 0; i < files; ++i) {
                    const std::string name = std::to_string(thread) + "/" + std::to_string(i) + ".svg";
                    MadeFile made = made_file(record, folder, name);
                    EXPECT_EQ(made.file.bytes, name.size());
                    EXPECT_FALSE(folder.status(name));
                    publisher.add(std::move(made), [&](const FinishedJob& job, const std::string& problem) {
                        EXPECT_EQ(contents(scratch / job.file), job.file);
                        const std::lock_guard guard(mutex);
                        done.emplace(job.file, problem);
                    });
                }
            });
        }
        for (std::thread& maker : makers) maker.join();
        publisher.finish();
    }
    EXPECT_EQ(done.size(), std::size_t{threads} * files);
    const std::string lines = contents(scratch / "gallery.jsonl");
    for (const auto& [name, problem] : done) {
        EXPECT_EQ(problem, "") << name;
        EXPECT_TRUE(has(lines, "{\"file\":\"" + name + "\"")) << name;
    }
    for (int thread = 0; thread < threads; ++thread) {
        for (const auto& entry : std::filesystem::directory_iterator(scratch / std::to_string(thread))) {
            EXPECT_EQ(entry.path().extension(), ".svg") << entry.path();
        }
    }
}

TEST(Publisher, AFileThatCannotAppearLeavesTheOthers) {
    const ScratchFolder scratch;
    const GalleryFolder folder(scratch.path());
    GalleryRecord record(folder, "gallery.jsonl", false, [] {});
    std::map<std::string, std::string> done;
    std::vector<MadeFile> files;
    for (const char* name : {"a.svg", "b.svg", "c.svg", "d.svg", "e.svg"}) {
        files.push_back(made_file(record, folder, name));
    }
    std::filesystem::create_directory(scratch / "c.svg");
    {
        Publisher publisher(record);
        for (MadeFile& file : files) {
            publisher.add(std::move(file), [&](const FinishedJob& job, const std::string& problem) {
                done.emplace(job.file, problem);
            });
        }
    }
    ASSERT_EQ(done.size(), 5u);
    EXPECT_EQ(done["c.svg"], "cannot write '" + (scratch / "c.svg").string() + "': Is a directory");
    const std::string lines = contents(scratch / "gallery.jsonl");
    for (const std::string name : {"a.svg", "b.svg", "d.svg", "e.svg"}) {
        EXPECT_EQ(done[name], "");
        EXPECT_EQ(contents(scratch / name), name);
        EXPECT_TRUE(has(lines, "{\"file\":\"" + name + "\""));
    }
    EXPECT_FALSE(has(lines, "{\"file\":\"c.svg\""));
}

TEST(Publisher, AnErrorOfItsThreadIsReported) {
    const ScratchFolder scratch;
    const GalleryFolder folder(scratch.path());
    GalleryRecord record(folder, "gallery.jsonl", false, [] {});
    Publisher publisher(record);
    publisher.add(made_file(record, folder, "a.svg"),
                  [](const FinishedJob&, const std::string&) { throw std::runtime_error("no memory"); });
    EXPECT_EQ(error_of([&] { publisher.finish(); }), "no memory");
    EXPECT_EQ(error_of([&] { publisher.finish(); }), "no memory");
}

TEST(Publisher, FewFilesWaitIfFewMayBeOpen) {
    struct rlimit known {};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &known), 0);
    for (const auto& [files, most] : {std::pair(4, 1u), std::pair(80, 10u), std::pair(1024, 100u)}) {
        struct rlimit limit = known;
        limit.rlim_cur = static_cast<rlim_t>(files);
        if (limit.rlim_cur > known.rlim_max) continue;
        EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
        EXPECT_EQ(Publisher::most_waiting(), most) << files;
    }
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &known), 0);
}

TEST(Publisher, WhatMakesNoFileIsReported) {
    const ScratchFolder scratch;
    const GalleryFolder folder(scratch.path());
    GalleryRecord record(folder, "gallery.jsonl", false, [] {});
    FinishedJob job;
    job.file = "a.svg";
    const auto nothing = [](const std::filesystem::path&, Destination&, FinishedJob&) {};
    EXPECT_EQ(error_of<std::runtime_error>([&] { make_gallery_file(record, folder, job, false, nothing); }),
              "nothing to write");
}

}  // namespace sikku::gallery_publisher_test
