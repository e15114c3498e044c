// tests/program/gallery_folder_test.cpp: galleries in untrusted folders never write, remove or read files outside
// them.
#include "engine/base/output_file.h"
#include "tests/gallery.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <iterator>

namespace sikku::gallery_folder_test {

namespace fs = std::filesystem;

class GalleryFolderTest : public GalleryTest {
protected:
    GalleryFolderTest() {
        fs::create_directories(folder / "out");
        fs::create_directories(folder / "home");
        folder.write("home/precious.svg", "mine");
    }
    void expect_home_untouched() const {
        EXPECT_EQ(tree(folder / "home"), (std::map<std::string, std::string>{{"precious.svg", "mine"}}));
    }
    void expect_refused(const Outcome& outcome, std::string_view message) const {
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(has(outcome.errors, message));
        expect_home_untouched();
    }
};

TEST_F(GalleryFolderTest, RecordsThatAreLinks) {
    const auto link = [&](const std::string& name, const std::string& target) {
        fs::remove_all(folder / "out");
        fs::create_directories(folder / "out");
        fs::create_symlink(target, folder / ("out/" + name));
    };
    const std::string refusal = "is a symbolic link; a gallery does not write through links";
    for (const char* target : {"../home/.bash_profile", "../home/precious.svg", "/dev/null"}) {
        link("gallery.jsonl", target);
        expect_refused(gallery({"hilbert", "-o", "out"}), "'out/gallery.jsonl' " + refusal);
        expect_refused(gallery({"hilbert", "-o", "out", "--force"}), "'out/gallery.jsonl' " + refusal);
        EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 1) << "the link";
        link("gallery-1-of-2.jsonl", target);
        expect_refused(gallery({"hilbert", "-o", "out", "--shard", "1/2"}), "'out/gallery-1-of-2.jsonl' " + refusal);
        link(".gallery.lock", target);
        expect_refused(gallery({"hilbert", "-o", "out"}), "'out/.gallery.lock' " + refusal);
    }
    // That of another part is left alone.
    folder.write("home/precious.svg", "{\"claim\":\"hilbert.svg\"}\n");
    link("gallery-1-of-2.jsonl", "../home/precious.svg");
    folder.write("out/hilbert.svg", "mine");
    EXPECT_EQ(gallery({"hilbert", "-o", "out"}).status, 1) << "the claim does not count";
    EXPECT_EQ(contents(folder / "out/hilbert.svg"), "mine");
    EXPECT_EQ(contents(folder / "home/precious.svg"), "{\"claim\":\"hilbert.svg\"}\n");
    EXPECT_TRUE(fs::is_symlink(folder / "out/gallery-1-of-2.jsonl"));
}

TEST_F(GalleryFolderTest, RecordsThatAreNotFiles) {
    for (const char* name : {"gallery.jsonl", ".gallery.lock"}) {
        ASSERT_EQ(mkfifo(folder.file(std::string("out/") + name).c_str(), 0600), 0);
        expect_refused(gallery({"hilbert", "-o", "out"}), "is not a regular file");
        fs::remove(folder / ("out/" + std::string(name)));
    }
    ASSERT_EQ(mkfifo(folder.file("out/gallery-1-of-2.jsonl").c_str(), 0600), 0);
    EXPECT_EQ(gallery({"hilbert", "-o", "out"}).status, 0) << "that of another part does not count";
    folder.write("out/.gallery.lock", "mine");
    EXPECT_EQ(gallery({"hilbert", "-o", "out"}).status, 1);
    EXPECT_EQ(contents(folder / "out/.gallery.lock"), "mine");
}

TEST_F(GalleryFolderTest, FoldersThatAreLinks) {
    // A hostile archive claims hilbert.svg and its temporary files as the gallery's own.
    fs::create_directory_symlink("../home", folder / "out/curves");
    folder.write("out/gallery.jsonl",
                 "{\"claim\":\"curves/precious.svg\"}\n{\"claim\":\"curves/../../home/precious.svg\"}\n");
    folder.write("home/.precious.svg.abcdef.tmp", "mine");
    const Outcome outcome = gallery({"hilbert", "-o", "out", "--name", "{kind}/precious"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "'out/curves' is a symbolic link; a gallery does not write through links"));
    EXPECT_EQ(gallery({"hilbert", "-o", "out", "--name", "{kind}/precious", "--force"}).status, 1);
    EXPECT_EQ(contents(folder / "home/.precious.svg.abcdef.tmp"), "mine");
    fs::remove(folder / "home/.precious.svg.abcdef.tmp");
    expect_home_untouched();
    // The gallery folder itself may be a link.
    fs::remove(folder / "out/curves");
    fs::create_directory_symlink("out", folder / "link");
    EXPECT_EQ(gallery({"hilbert", "-o", "link", "--name", "{kind}/precious"}).status, 0);
    EXPECT_TRUE(fs::is_regular_file(folder / "out/curves/precious.svg"));
}

TEST_F(GalleryFolderTest, OutputsThatAreLinks) {
    for (const char* name : {"index.html", "poster.svg", "hilbert.svg"}) {
        fs::create_symlink("../home/precious.svg", folder / ("out/" + std::string(name)));
    }
    const std::vector<std::string> asked = {"hilbert", "-o", "out", "--poster", "A6", "--keep-going"};
    expect_refused(gallery(asked), "was not made by this gallery");
    EXPECT_TRUE(fs::is_symlink(folder / "out/index.html"));
    // A forged record that claims them as the gallery's own.
    folder.write("out/gallery.jsonl", "{\"claim\":\"hilbert.svg\"}\n{\"claim\":\"poster.svg\"}\n");
    EXPECT_EQ(gallery(asked).status, 1) << "the page is still not its own";
    std::vector<std::string> forced = asked;
    forced.push_back("--force");
    EXPECT_EQ(gallery(forced).status, 0);
    for (const char* name : {"index.html", "poster.svg", "hilbert.svg"}) {
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / ("out/" + std::string(name))))) << name;
    }
    expect_home_untouched();
    // A pipe that nobody reads does not stop the run.
    fs::remove(folder / "out/hilbert.svg");
    ASSERT_EQ(mkfifo(folder.file("out/hilbert.svg").c_str(), 0600), 0);
    EXPECT_EQ(gallery(forced).status, 0);
    EXPECT_TRUE(fs::is_regular_file(folder / "out/hilbert.svg"));
}

TEST_F(GalleryFolderTest, ScriptsForSlurm) {
    const std::vector<std::string> asked = {"hilbert", "-o", "out", "--slurm", "2"};
    const std::vector<std::pair<std::string, std::string>> no_slurm = {{"PATH", folder.file("none")}};
    fs::create_symlink("home/precious.svg", folder / "out.sbatch");
    expect_refused(gallery(asked, no_slurm), "is not a gallery script");
    // Not even if it looks like one.
    folder.write("home/precious.svg", "#!/bin/sh\n#SBATCH --job-name=sikku-gallery\n");
    EXPECT_EQ(gallery(asked, no_slurm).status, 1);
    std::vector<std::string> forced = asked;
    forced.push_back("--force");
    EXPECT_EQ(gallery(forced, no_slurm).status, 0);
    EXPECT_FALSE(fs::is_symlink(folder / "out.sbatch"));
    EXPECT_EQ(gallery(asked, no_slurm).status, 0) << "its own is replaced";
    EXPECT_EQ(contents(folder / "home/precious.svg"), "#!/bin/sh\n#SBATCH --job-name=sikku-gallery\n");
}

TEST_F(GalleryFolderTest, LinksThatAppearDuringTheRun) {
    const std::vector<std::string> asked = {"gallery", "hilbert", "-n", "8",   "-f",     "png",
                                            "--size",  "A1",      "-o", "out", "--name", "s/x"};
    {
        Child child(asked, {.folder = folder.path()});
        ASSERT_TRUE(await([&] { return has_temporary(folder / "out/s", "x.png"); }));
        fs::create_symlink("../../home/precious.svg", folder / "out/s/x.png");
        EXPECT_EQ(child.wait().status, 0);
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "out/s/x.png")));
        expect_home_untouched();
    }
    fs::remove_all(folder / "out");
    {
        Child child(asked, {.folder = folder.path()});
        ASSERT_TRUE(await([&] { return has_temporary(folder / "out/s", "x.png"); }));
        fs::rename(folder / "out/s", folder / "out/t");
        fs::create_directory_symlink("../home", folder / "out/s");
        EXPECT_EQ(child.wait().status, 1);
        expect_home_untouched();
    }
}

TEST_F(GalleryFolderTest, AFolderThatIsHeldOpen) {
    const int held = open(folder.file("out").c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    ASSERT_GE(held, 0);
    const std::string there = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(held) + "/";
    fs::rename(folder / "out", folder / "moved");
    fs::create_directory_symlink("home", folder / "out");
    fs::create_symlink("../home/precious.svg", folder / "moved/link");
    ASSERT_EQ(mkfifo(folder.file("moved/pipe").c_str(), 0600), 0);
    for (const char* name : {"file", "link", "pipe"}) {
        OutputFile output(there + name);
        output.write("text");
        output.commit();
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / ("moved/" + std::string(name))))) << name;
    }
    EXPECT_EQ(folder.names().size(), 5U);
    EXPECT_EQ(tree(folder / "moved"),
              (std::map<std::string, std::string>{{"file", "text"}, {"link", "text"}, {"pipe", "text"}}));
    close(held);
    expect_home_untouched();
}

TEST_F(GalleryFolderTest, ProfilesOfInksBelongToTheJob) {
    std::string profile;
    for (const char* name : {"/usr/share/color/icc/ghostscript/default_cmyk.icc",
                             "/usr/share/ghostscript/iccprofiles/default_cmyk.icc"}) {
        if (fs::exists(name)) profile = contents(name);
    }
    if (profile.empty()) GTEST_SKIP() << "no CMYK profile on this machine";
    fs::create_directories(folder / "book");
    folder.write("book/inks.icc", profile);
    folder.write("book/g.toml", "pattern = 'hilbert'\nformat = 'tif'\nsize = '40x40mm'\ncmyk = 'inks.icc'\n");
    const std::vector<std::string> asked = {"--file", "book/g.toml", "-o", "out"};
    const Outcome first = gallery(asked);
    EXPECT_EQ(first.status, 0) << first.errors;
    EXPECT_TRUE(has(gallery(asked).errors, "0 made, 1 up to date"));
    // The time at which it was made, 24 to 35, decides nothing; but it is another profile.
    profile[35] = static_cast<char>(profile[35] ^ 1);
    folder.write("book/inks.icc", profile);
    EXPECT_TRUE(has(gallery(asked).errors, "1 made"));
    EXPECT_TRUE(has(gallery(asked).errors, "0 made"));
}

}  // namespace sikku::gallery_folder_test
