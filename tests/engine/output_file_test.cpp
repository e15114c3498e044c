#include "engine/base/output_file.h"

#include "tests/checks.h"
#include "tests/print_tools.h"

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <thread>

namespace sikku::output_file_test {

namespace fs = std::filesystem;

mode_t mode_of(const fs::path& path) {
    struct stat status {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return status.st_mode & 0777;
}

std::string complaint_of_writing(const fs::path& path, std::size_t bytes = 10) {
    return error_of([&] {
        OutputFile file(path);
        file.write(std::string(bytes, 'x'));
        file.commit();
    });
}

class Umask {
public:
    explicit Umask(mode_t mask) : before_(::umask(mask)) {}
    ~Umask() { ::umask(before_); }
    Umask(const Umask&) = delete;
    Umask& operator=(const Umask&) = delete;

private:
    mode_t before_;
};

TEST(OutputFile, AppearsOnCommitAndNotBefore) {
    const ScratchFolder folder;
    const auto target = folder / "a.svg";
    OutputFile file(target);
    file.write("hello");
    EXPECT_EQ(file.size(), 5u);
    EXPECT_FALSE(fs::exists(target));
    EXPECT_EQ(file.temporary().parent_path(), folder.path());
    const std::string name = file.temporary().filename().string();
    EXPECT_TRUE(name.starts_with(".a.svg.") && name.ends_with(".tmp") && name.size() == 17) << name;
    file.commit();
    EXPECT_EQ(contents(target), "hello");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.svg"});
}

TEST(OutputFile, WithoutCommitTheOldFileStays) {
    const ScratchFolder folder;
    const auto target = folder / "a";
    std::ofstream(target) << "old";
    {
        OutputFile file(target);
        file.write(std::string(3 << 20, 'x'));
    }
    EXPECT_EQ(contents(target), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
    EXPECT_EQ(complaint_of_writing(target), "");
    EXPECT_EQ(contents(target), "xxxxxxxxxx");
}

TEST(OutputFile, PiecesOfAllSizesComeOutInOrder) {
    const ScratchFolder folder;
    const auto target = folder / "a";
    std::string expected;
    OutputFile file(target);
    for (const std::size_t size : {1, 1000, 1 << 20, (1 << 20) - 1, 1, 3 << 20, 0, 700'000, 700'000, 5}) {
        const std::string piece(size, static_cast<char>('a' + expected.size() % 26));
        file.write(piece);
        expected += piece;
    }
    EXPECT_EQ(file.size(), expected.size());
    file.commit();
    EXPECT_TRUE(contents(target) == expected);
}

TEST(OutputFile, InsertsAnywhere) {
    const ScratchFolder folder;
    const auto target = folder / "a";
    std::string expected;
    for (int i = 0; i < 400'000; ++i) expected += std::to_string(i);
    OutputFile file(target);
    ASSERT_TRUE(file.can_insert());
    file.write(expected);
    const std::string large(1'500'000, '#');
    for (const auto& [position, bytes] : {std::pair<std::size_t, std::string>{0, "begin"},
                                          {1'000'000, large},
                                          {17, ""},
                                          {expected.size(), "middle"}}) {
        file.insert(position, bytes);
        expected.insert(position, bytes);
        file.write("more");
        expected += "more";
    }
    file.insert(file.size(), "end");
    expected += "end";
    EXPECT_THROW(file.insert(file.size() + 1, "x"), std::logic_error);
    file.commit();
    EXPECT_TRUE(contents(target) == expected);
}

TEST(OutputFile, TheModeIsThatOfTheUmaskOrOfTheOldFile) {
    const ScratchFolder folder;
    {
        const Umask umask(0027);
        EXPECT_EQ(complaint_of_writing(folder / "new"), "");
        EXPECT_EQ(mode_of(folder / "new"), 0640u);
    }
    for (const mode_t mode : {0600, 0604, 0777}) {
        const Umask umask(0022);
        ASSERT_EQ(::chmod((folder / "new").c_str(), mode), 0);
        OutputFile file(folder / "new");
        EXPECT_EQ(mode_of(file.temporary()) & ~mode, 0u) << "never more open than the old file";
        file.commit();
        EXPECT_EQ(mode_of(folder / "new"), mode);
    }
}

TEST(OutputFile, LibrariesMayWriteTheTemporaryFile) {
    const ScratchFolder folder;
    OutputFile file(folder / "a.png");
    std::ofstream(file.temporary(), std::ios::binary) << "pixels";
    file.commit();
    EXPECT_EQ(contents(folder / "a.png"), "pixels");
    EXPECT_EQ(folder.names().size(), 1u);
}

TEST(OutputFile, SymbolicLinksAreFollowed) {
    const ScratchFolder folder;
    fs::create_directory(folder / "deep");
    for (const bool exists : {false, true}) {
        const std::string name = exists ? "there" : "new";
        if (exists) std::ofstream(folder / "deep/there") << "old";
        fs::create_symlink("deep/" + name, folder / (name + "_link"));
        fs::create_symlink(name + "_link", folder / (name + "_link_link"));
        EXPECT_EQ(complaint_of_writing(folder / (name + "_link_link")), "");
        EXPECT_TRUE(fs::is_symlink(folder / (name + "_link")));
        EXPECT_EQ(contents(folder / ("deep/" + name)), "xxxxxxxxxx");
    }
    fs::create_symlink("self", folder / "self");
    EXPECT_TRUE(has(complaint_of_writing(folder / "self"), "symbolic links"));
}

TEST(OutputFile, LinksThatAppearLaterAreNotFollowed) {
    const ScratchFolder folder;
    std::ofstream(folder / "precious") << "mine";
    ASSERT_EQ(::chmod((folder / "precious").c_str(), 0600), 0);
    {
        OutputFile file(folder / "target");
        file.write("new");
        fs::create_symlink("precious", folder / "target");
        file.commit();
        EXPECT_FALSE(fs::is_symlink(folder / "target"));
        EXPECT_EQ(contents(folder / "target"), "new");
    }
    {
        OutputFile file(folder / "target");
        ASSERT_EQ(::chmod((folder / "target").c_str(), 0644), 0);
        const fs::path temporary = file.temporary();
        fs::remove(temporary);
        fs::create_symlink("precious", temporary);
        EXPECT_TRUE(has(error_of([&] { file.commit(); }), "symbolic links"));
    }
    EXPECT_EQ(contents(folder / "target"), "new");
    EXPECT_EQ(contents(folder / "precious"), "mine");
    EXPECT_EQ(mode_of(folder / "precious"), 0600u);
    EXPECT_EQ(folder.names().size(), 2u);
}

TEST(OutputFile, CommitSynchronisesTheDescriptorThatWasWritten) {
    const ScratchFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        OutputFile file(folder / "a");
        file.write("whole");
        // No further file can be opened.
        const rlimit none{0, 0};
        if (::setrlimit(RLIMIT_NOFILE, &none) != 0) ::_exit(3);
        ::_exit(error_of([&] { file.commit(); }).empty() ? 0 : 4);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    EXPECT_EQ(contents(folder / "a"), "whole");
}

TEST(OutputFile, FailuresNameTheTargetAndTheCause) {
    const ScratchFolder folder;
    std::ofstream(folder / "file") << "old";
    const std::string missing = (folder / "no/such/a.svg").string();
    EXPECT_EQ(complaint_of_writing(missing),
              "cannot write '" + missing + "': the folder '" + (folder / "no/such").string() + "' does not exist");
    EXPECT_TRUE(has(complaint_of_writing(folder.path()), "Is a directory"));
    EXPECT_TRUE(has(complaint_of_writing(folder / "new/"), "Is a directory"));
    EXPECT_TRUE(has(complaint_of_writing(folder / "file/a"), "Not a directory"));
    EXPECT_TRUE(has(complaint_of_writing(folder / std::string(300, 'n')), "name too long"));
    EXPECT_TRUE(has(complaint_of_writing(""), "No such file"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(OutputFile, LongNamesHaveTemporaryNamesThatFit) {
    const ScratchFolder folder;
    std::string name;
    while (name.size() < 255) name += "\xE0\xAE\x95";  // க
    EXPECT_EQ(complaint_of_writing(folder / name), "");
    EXPECT_EQ(folder.names(), std::vector<std::string>{name});
}

TEST(OutputFile, WhatMayNotBeWrittenIsLeftAlone) {
    if (::geteuid() == 0) {
        // Root may write everything: the same as somebody else, in a process of its own.
        const ScratchFolder folder;
        fs::create_directory(folder / "mine");
        std::ofstream(folder / "mine/read_only") << "old";
        fs::create_directory(folder / "closed");
        ASSERT_EQ(::chmod(folder.path().c_str(), 0755), 0);
        ASSERT_EQ(::chmod((folder / "mine").c_str(), 0777), 0);
        ASSERT_EQ(::chmod((folder / "mine/read_only").c_str(), 0444), 0);
        ASSERT_EQ(::chmod((folder / "closed").c_str(), 0555), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            if (::setuid(65534) != 0) ::_exit(3);
            const bool refused =
                complaint_of_writing(folder / "mine/read_only").find("Permission denied") != std::string::npos &&
                complaint_of_writing(folder / "closed/a").find("Permission denied") != std::string::npos;
            ::_exit(refused ? 0 : 1);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
        EXPECT_EQ(contents(folder / "mine/read_only"), "old");
        EXPECT_TRUE(fs::is_empty(folder / "closed"));
        return;
    }
    const ScratchFolder folder;
    std::ofstream(folder / "read_only") << "old";
    ASSERT_EQ(::chmod((folder / "read_only").c_str(), 0444), 0);
    EXPECT_TRUE(has(complaint_of_writing(folder / "read_only"), "Permission denied"));
    EXPECT_EQ(contents(folder / "read_only"), "old");
    fs::create_directory(folder / "closed");
    ASSERT_EQ(::chmod((folder / "closed").c_str(), 0555), 0);
    EXPECT_TRUE(has(complaint_of_writing(folder / "closed/a"), "Permission denied"));
}

TEST(OutputFile, AFullDiskIsReportedAndLeavesNothing) {
    EXPECT_EQ(complaint_of_writing("/dev/full"), "cannot write '/dev/full': No space left on device");
    const ScratchFolder folder;
    if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=1m") != 0) {
        GTEST_SKIP() << "a small disk cannot be mounted here";
    }
    std::ofstream(folder / "old") << "old";
    EXPECT_EQ(complaint_of_writing(folder / "old", 5 << 20),
              "cannot write '" + (folder / "old").string() + "': No space left on device");
    EXPECT_EQ(contents(folder / "old"), "old");
    EXPECT_TRUE(has(error_of([&] {
                        OutputFile file(folder / "inserted");
                        file.write(std::string(700'000, 'x'));
                        file.insert(3, std::string(700'000, 'y'));
                    }),
                    "No space left"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"old"});
    ::umount(folder.path().c_str());
}

TEST(OutputFile, DevicesAndPipesAreWrittenStraightTo) {
    EXPECT_EQ(complaint_of_writing("/dev/null", 3 << 20), "");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = contents(folder / "pipe"); });
    EXPECT_EQ(complaint_of_writing(folder / "pipe"), "");
    reader.join();
    EXPECT_EQ(received, "xxxxxxxxxx");
    OutputFile null("/dev/null");
    EXPECT_FALSE(null.can_insert());
    EXPECT_THROW(null.insert(0, "x"), std::logic_error);
}

TEST(OutputFile, StandardOutputGoesOnWhereTheShellIs) {
    const ScratchFolder folder;
    std::FILE* opened = std::fopen((folder / "out").c_str(), "w");
    ASSERT_TRUE(opened);
    std::fputs("before ", opened);
    std::fflush(opened);
    EXPECT_EQ(complaint_of_writing("/dev/fd/" + std::to_string(::fileno(opened))), "");
    std::fputs(" after", opened);
    std::fclose(opened);
    EXPECT_EQ(contents(folder / "out"), "before xxxxxxxxxx after");
    EXPECT_TRUE(has(complaint_of_writing("/dev/fd/987"), "Bad file descriptor"));
    EXPECT_TRUE(fs::is_symlink("/dev/stdout") || !fs::exists("/dev/stdout"));
}

TEST(OutputFile, ASignalLeavesNothingIfTheHandlerAsks) {
    const ScratchFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGTERM, [](int) {
            remove_unfinished_files();
            ::_exit(5);
        });
        // Many, so that places in the list are used again and new ones are made.
        std::vector<std::unique_ptr<OutputFile>> open;
        for (int round = 0; round < 3; ++round) {
            for (int i = 0; i < 200; ++i) {
                open.push_back(std::make_unique<OutputFile>(folder / ("file" + std::to_string(i))));
            }
            OutputFile done(folder / "done");
            done.commit();
            open.resize(open.size() / 2);
        }
        std::raise(SIGTERM);
        ::_exit(6);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 5) << status;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"done"});
}

TEST(OutputFiles, AppearTogether) {
    const ScratchFolder folder;
    fs::create_directory(folder / "below");
    for (const int count : {1, 3, 40}) {
        OutputFiles first, second;
        for (int i = 0; i < count; ++i) {
            first.add(folder / std::to_string(i), "first");
            const auto file = second.open(folder / "below" / std::to_string(i));
            file->write("sond");
            file->insert(1, "ec");
            file->commit();
        }
        const fs::path temporary = first.temporary(folder / "0");
        EXPECT_EQ(temporary.parent_path(), folder.path());
        EXPECT_EQ(contents(temporary), "first");
        EXPECT_EQ(first.temporary(folder / "other"), "");
        EXPECT_FALSE(fs::exists(folder / "0"));
        EXPECT_FALSE(fs::exists(folder / "below/0"));
        const std::array<OutputFiles*, 2> both = {&first, &second};
        OutputFiles::commit(both);
        for (int i = 0; i < count; ++i) {
            EXPECT_EQ(contents(folder / std::to_string(i)), "first");
            EXPECT_EQ(contents(folder / "below" / std::to_string(i)), "second");
        }
        EXPECT_EQ(folder.names().size(), count + 1u);
        for (const auto& name : folder.names()) {
            if (name != "below") fs::remove(folder / name);
        }
        fs::remove_all(folder / "below");
        fs::create_directory(folder / "below");
    }
}

TEST(OutputFiles, WithoutCommitNothingStays) {
    const ScratchFolder folder;
    {
        OutputFiles files;
        files.add(folder / "a", "x");
        const auto unfinished = files.open(folder / "b");
        unfinished->write("y");
        OutputFiles moved = std::move(files);
        EXPECT_EQ(folder.names().size(), 2u);
        unfinished->commit();
    }
    EXPECT_TRUE(folder.names().empty());
}

TEST(OutputFiles, AnErrorLeavesTheOthersToAnotherCall) {
    const ScratchFolder folder;
    std::array<OutputFiles, 5> groups;
    std::vector<OutputFiles*> all;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        groups[i].add(folder / std::to_string(i), "x");
        all.push_back(&groups[i]);
    }
    fs::create_directory(folder / "2");
    EXPECT_EQ(error_of([&] { OutputFiles::commit(all); }),
              "cannot write '" + (folder / "2").string() + "': Is a directory");
    EXPECT_EQ(contents(folder / "1"), "x");
    EXPECT_FALSE(fs::exists(folder / "3"));
    for (std::size_t i = 0; i < groups.size(); ++i) {
        EXPECT_EQ(error_of([&] { groups[i].commit(); }).empty(), i != 2);
        EXPECT_EQ(fs::is_regular_file(folder / std::to_string(i)), i != 2);
    }
}

TEST(OutputFiles, AFolderThatCannotBeOpenedIsAnError) {
    const ScratchFolder folder;
    OutputFiles files;
    struct rlimit known {};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &known), 0);
    const int next = ::dup(STDERR_FILENO);
    ::close(next);
    // Enough for the file, but not for its folder.
    struct rlimit one_more = known;
    one_more.rlim_cur = static_cast<rlim_t>(next) + 1;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &one_more), 0);
    const std::string problem = error_of([&] { files.add(folder / "a", "x"); });
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &known), 0);
    EXPECT_EQ(problem, "cannot write '" + (folder / "a").string() + "': Too many open files");
    EXPECT_TRUE(folder.names().empty());
    files.add(folder / "a", "x");
    files.commit();
    EXPECT_EQ(contents(folder / "a"), "x");
}

}  // namespace sikku::output_file_test
