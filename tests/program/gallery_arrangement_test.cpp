// tests/program/gallery_arrangement_test.cpp: arrangements as items of galleries.
#include "tests/gallery.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sikku::gallery_arrangement_test {

class GalleryArrangement : public GalleryTest {
protected:
    GalleryArrangement() {
        std::filesystem::create_directory(folder / "pieces");
        folder.write("pieces/mine.lsys", mine);
        folder.write("pieces/piece.toml", piece);
    }

    const std::string mine = "axiom: X\nderivation length: 2\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";
    const std::string piece =
        "title = 'Two of a kind'\ntempo = 100\n\n[[track]]\npattern = 'hilbert'\nn = 3\n\n"
        "[[track]]\npattern = 'mine.lsys'\nstart = 1\n";
};

TEST_F(GalleryArrangement, IsMadeAsThePlayerMakesIt) {
    folder.write("items.toml",
                 "[[item]]\npattern = 'pieces/piece.toml'\nformat = ['mid', 'musicxml', 'notes.svg', 'html']\n"
                 "[[item]]\npattern = 'canon'\n[[item]]\npattern = 'hilbert'\nn = 3\n");
    const Outcome made = gallery({"--file", "items.toml", "-o", "out"});
    ASSERT_EQ(made.status, 0) << made.errors;
    for (const auto& [score, file] :
         {std::pair("x.mid", "piece.mid"), {"x.musicxml", "piece.musicxml"}, {"x.svg", "piece.notes.svg"}}) {
        ASSERT_EQ(run({"play", "pieces/piece.toml", "-o", score}, {.folder = folder.path()}).status, 0);
        EXPECT_EQ(contents(folder / score), contents(folder / "out" / file)) << file;
    }
    ASSERT_EQ(run({"play", "canon", "-o", "y.mid"}, {.folder = folder.path()}).status, 0);
    EXPECT_EQ(contents(folder / "y.mid"), contents(folder / "out/canon.mid"));
    EXPECT_TRUE(has(contents(folder / "out/index.html"), "Two of a kind"));

    // The manifest of the gallery makes the same files.
    const Outcome list = gallery({"--file", "items.toml", "--list", "--json"});
    EXPECT_EQ(lines_of(list.output), 6U);
    folder.write("jobs.jsonl", list.output);
    ASSERT_EQ(gallery({"--manifest", "jobs.jsonl", "-o", "two"}).status, 0);
    EXPECT_EQ(differences(tree(folder / "out"), tree(folder / "two")), "");

    // Shards make the same files.
    for (const char* shard : {"1/2", "2/2"}) {
        ASSERT_EQ(gallery({"--file", "items.toml", "-o", "three", "--shard", shard}).status, 0);
    }
    ASSERT_EQ(gallery({"--file", "items.toml", "-o", "three"}).status, 0);
    for (const char* file : {"piece.mid", "piece.html", "canon.mid", "hilbert.svg", "index.html"}) {
        EXPECT_EQ(contents(folder / "three" / file), contents(folder / "out" / file)) << file;
    }
    EXPECT_EQ(gallery({"--file", "items.toml", "--dry-run"}).status, 0);
}

TEST_F(GalleryArrangement, IsMadeAgainWhenItsPatternsChange) {
    const std::vector<std::string> asked = {"pieces/piece.toml", "hilbert", "-f", "mid", "-o", "out"};
    ASSERT_EQ(gallery(asked).status, 0);
    const std::string before = contents(folder / "out/piece.mid");
    EXPECT_TRUE(has(gallery(asked).errors, "0 made, 2 up to date"));
    folder.write("pieces/mine.lsys", "seed: 7\n" + mine);
    EXPECT_TRUE(has(gallery(asked).errors, "1 made"));
    EXPECT_TRUE(has(gallery(asked).errors, "0 made, 2 up to date"));
    folder.write("pieces/mine.lsys", mine);
    folder.write("pieces/piece.toml", piece + "inversion = true\n");
    EXPECT_TRUE(has(gallery(asked).errors, "1 made"));
    EXPECT_NE(contents(folder / "out/piece.mid"), before);
    folder.write("pieces/piece.toml", piece);
    EXPECT_TRUE(has(gallery(asked).errors, "1 made"));
    EXPECT_EQ(contents(folder / "out/piece.mid"), before);
}

TEST_F(GalleryArrangement, OptionsNameFilesBesideTheGallery) {
    folder.write("five.scl", "! five.scl\n!\nFive equal steps\n 5\n!\n 240.\n 480.\n 720.\n 960.\n 2/1\n");
    folder.write("items.toml",
                 "[[item]]\npattern = 'pieces/piece.toml'\nformat = 'mid'\nscale = 'five.scl'\ntempo = [90, 60]\n");
    const Outcome made = gallery({"--file", "items.toml", "-o", "out"});
    ASSERT_EQ(made.status, 0) << made.errors;
    EXPECT_NE(contents(folder / "out/piece-tempo90.mid"), contents(folder / "out/piece-tempo60.mid"));
    // The file counts as part of the piece.
    folder.write("five.scl", "! five.scl\n!\nFive steps\n 5\n!\n 200.\n 480.\n 720.\n 960.\n 2/1\n");
    EXPECT_TRUE(has(gallery({"--file", "items.toml", "-o", "out"}).errors, "2 made"));
}

TEST_F(GalleryArrangement, IsFoundByGlobAndKind) {
    const Outcome glob = gallery({"pieces/*.toml", "--list"});
    EXPECT_EQ(glob.output, "piece.mid  pieces/piece.toml\n") << glob.errors;
    EXPECT_EQ(gallery({"pieces", "--list"}).output, "mine.svg  pieces/mine.lsys\n");
    const Outcome kind = gallery({"arrangements", "--list"});
    EXPECT_EQ(lines_of(kind.output), lines_of(run({"patterns", "arrangements", "--names"}).output)) << kind.errors;
    EXPECT_EQ(gallery({"arrangements/canon", "--list"}).output, "canon.mid  canon\n");
}

TEST_F(GalleryArrangement, RefusesWhatItCannotHave) {
    folder.write("items.toml", "[[item]]\npattern = 'pieces/piece.toml'\nformat = ['mid', 'svg']\n");
    const Outcome drawn = gallery({"--file", "items.toml"});
    EXPECT_EQ(drawn.status, 2);
    EXPECT_TRUE(
        has(drawn.errors, "items.toml:1:1: svg: 'pieces/piece.toml' is an arrangement, which has no drawing"));
    EXPECT_EQ(lines_of(drawn.errors), 1U) << drawn.errors;
    for (const char* key : {"n = 3", "seed = 2", "variant = 'a'", "set = { n = 3 }", "angle = 80"}) {
        folder.write("items.toml", std::string("[[item]]\npattern = 'pieces/piece.toml'\n") + key + "\n");
        const Outcome outcome = gallery({"--file", "items.toml"});
        EXPECT_EQ(outcome.status, 2) << key;
        EXPECT_TRUE(has(outcome.errors, "items.toml:3:"));
        EXPECT_TRUE(has(outcome.errors, "whose tracks set the keys of their patterns"));
    }
    const Outcome tempo = gallery({"pieces/piece.toml", "--set", "tempo=90", "--list"});
    EXPECT_TRUE(has(tempo.errors, "; 'tempo' without 'set' applies to all tracks"));
    EXPECT_EQ(gallery({"pieces/piece.toml", "--tempo", "90", "--list"}).status, 0);
    // Mistakes in the arrangement, and in its patterns, have their places there.
    folder.write("pieces/piece.toml", "tempo = 100\n[[track]]\npattern = 'mine.lsys'\nscael = 'dorian'\n");
    const Outcome key = gallery({"pieces/piece.toml", "hilbert", "-f", "mid", "--keep-going", "-o", "out"});
    EXPECT_EQ(key.status, 1);
    EXPECT_TRUE(has(key.errors, "piece.mid failed: pieces/piece.toml:4:1: unknown key 'scael'"));
    EXPECT_TRUE(std::filesystem::exists(folder / "out/hilbert.mid"));
    EXPECT_EQ(gallery({"pieces/piece.toml", "--dry-run"}).status, 1);
    folder.write("pieces/piece.toml", "[[track]]\npattern = 'mine.lsys'\n");
    folder.write("pieces/mine.lsys", "axiom: X\nderivation length: two\nX --> FX\n");
    const Outcome pattern = gallery({"pieces/piece.toml", "-o", "two"});
    EXPECT_EQ(pattern.status, 1);
    EXPECT_TRUE(has(pattern.errors, "mine.lsys:2:"));
    folder.write("pieces/piece.toml", "[[track]]\npattern = '-'\n");
    EXPECT_TRUE(has(gallery({"pieces/piece.toml", "-o", "two"}).errors, "standard input"));
}

}  // namespace sikku::gallery_arrangement_test
