// tests/program/gallery_keys_test.cpp: which options of single works are keys of galleries.
#include "art/gallery/jobs.h"
#include "art/gallery/values.h"
#include "art/prints.h"
#include "engine/base/output.h"
#include "music/scores.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::gallery_keys_test {

const GalleryKeys& keys() {
    static const GalleryKeys known({&prints(), &scores()});
    return known;
}
std::vector<GalleryJob> jobs(const std::string& text) {
    GalleryRequest request;
    request.gallery_file = "gallery.toml";
    request.gallery_text = text;
    request.bundled_only = true;
    return gallery_jobs(request, keys());
}
std::string refusal(const std::string& text) {
    return error_of<GalleryError>([&] { jobs(text); }, "none");
}

TEST(GalleryKeys, AreTheOptionsOfSingleFiles) {
    for (const OptionInfo* option : prints().options()) {
        if (option->is_key) continue;
        const std::string name = (option->is_on ? "no-" : "") + std::string(option->name);
        EXPECT_EQ(keys().find(name) != nullptr, !option->is_alone) << name;
        EXPECT_EQ(keys().not_a_key(option->name).empty(), !option->is_alone) << name;
    }
    for (const char* name : {"fill-page", "swatch", "lesson", "tile", "overlap", "frame-time", "hold"}) {
        EXPECT_TRUE(keys().find(name)) << name;
    }
    EXPECT_EQ(refusal("frames = true\npattern = \"square\"\n"),
              "gallery.toml:1:1: 'frames' is an option of single works, not a key of galleries: each job makes one "
              "file of one derivation length; 'n' lists derivation lengths");
    EXPECT_TRUE(has(refusal("fit-frames = true\npattern = \"square\"\n"), "'n' lists derivation lengths"));
    EXPECT_TRUE(has(refusal("fil-page = true\npattern = \"square\"\n"), "did you mean 'fill-page'?"));
}

/// `true` stands for the default of a value that may be left out.
TEST(GalleryKeys, HaveDefaults) {
    const auto made = [](const std::string& more) {
        std::vector<std::string> values;
        for (const GalleryJob& job : jobs("pattern = \"honeycomb\"\nformat = \"svg\"\nstep = \"5mm\"\n" + more)) {
            const auto found = job.keys.find("swatch");
            values.push_back(found == job.keys.end() ? "absent" : found->second);
        }
        return values;
    };
    using Values = std::vector<std::string>;
    EXPECT_EQ(made("swatch = true\n"), Values{""});
    EXPECT_EQ(made("swatch = false\n"), Values{"absent"});
    EXPECT_EQ(made("swatch = \"turn\"\n"), Values{"turn"});
    EXPECT_TRUE(has(refusal("pattern = \"honeycomb\"\nswatch = \"around\"\n"), "expected turn, or no value"));
}

/// Each makes one file.
TEST(GalleryKeys, MakeWhatTheySay) {
    for (const char* more :
         {"pattern = \"honeycomb\"\nswatch = true\n", "pattern = \"square\"\nfill-page = true\n",
          "pattern = \"snake-kolam\"\nn = 1\nlesson = true\n",
          "pattern = \"hat\"\nn = 2\ndivide = 0.5\nframe-time = 0.1\nhold = 0.5\n",
          "pattern = \"hilbert\"\nformat = \"pdf\"\nsize = \"A3\"\ntile = \"A4\"\noverlap = \"8mm\"\n"}) {
        const std::string text =
            std::string(more).find("format") == std::string::npos ? "format = \"svg\"\n" + std::string(more) : more;
        const std::vector<GalleryJob> list = jobs(text);
        ASSERT_EQ(list.size(), 1U) << more;
        MemoryDestination files;
        list.front().work()->make(files, list.front().file(), {});
        ASSERT_EQ(files.outputs().size(), 1U) << more;
        EXPECT_FALSE(files.outputs().begin()->second.empty()) << more;
    }
    EXPECT_TRUE(has(refusal("pattern = \"hilbert\"\nformat = \"png\"\ntile = \"A4\"\n"),
                    "tile: sheets as png are several files, and each job of a gallery makes one"));
}

TEST(GalleryMistakes, HavePlaces) {
    const auto refused = [](const std::string& text, std::string_view message) {
        EXPECT_TRUE(has(refusal(text), message)) << text;
    };
    refused("dpi = 100\nanlge = 3\n", "gallery.toml:2:1: unknown key 'anlge'; did you mean 'angle'?");
    refused("[[item]]\npattern = 'hilbert'\n  marign = '1cm'\n", "gallery.toml:3:3: unknown key 'marign'");
    refused("x = \n", "gallery.toml:1:5");
    refused("pattern = 'hilbert'\nn = 2\nset = { 'derivation length' = [1, 2] }\n",
            "gallery.toml:3:9: 'n' and 'derivation length' in 'set' are the same; use one of them");
    refused("pattern = 'hilbert'\nstroke = '1mm red'\nset = { stroke = '2mm blue' }\n",
            "'stroke' and 'stroke' in 'set' are the same");
    refused("pattern = 'hilbert'\nformat = 'mid'\nscale = ['dorian', 'foo']\n", "gallery.toml:3:1: ");
    refused("pattern = 'hilbert'\nformat = 'mid'\ntempo = 0\n", "gallery.toml:3:1: ");
    refused("pattern = 'hilbert'\nn = 'a'\n", "gallery.toml:2:1: n: expected a whole number");
    refused("pattern = 'hilbert'\nn = -1\n", "gallery.toml:2:1: n: expected a whole number");
    refused("pattern = 'hilbert'\nn = '5:1'\n", "gallery.toml:2:1: n: the range 5:1 is empty");
    refused("pattern = 'hilbert'\nn = []\n", "gallery.toml:2:1: n: this list is empty");
    refused("[[item]]\nn = 3\n", "gallery.toml:1:1: this item has no pattern");
    refused("pattern = 'hilbrt'\n", "gallery.toml:1:1: no file or pattern named 'hilbrt'; did you mean 'hilbert'?");
    refused("format = 'sgv'\n", "gallery.toml:1:1: unknown format 'sgv'; did you mean 'svg'?");
    refused("set = { '' = 1 }\n", "gallery.toml:1:9: set: a key is empty");
    refused("set = { title = \"a\\u001Bb\" }\n", "gallery.toml:1:9: title: 'a?b' contains a control character");
    refused("pattern = 'hilbert'\nsize = '3x'\n", "gallery.toml:2:1: size 3x");
    refused("pattern = 'hilbert'\nn = 2\nname = 'a-{m}'\n", "gallery.toml:3:1: name: unknown placeholder {m}");
    refused("pattern = 'hilbert'\nname = '../x'\n", "gallery.toml:2:1: name: '../x' cannot be");
    refused("pattern = 'hilbert'\nname = '.x'\n", "cannot be the name");
    refused("pattern = ['hilbert', 'dragon']\nname = 'x'\n", "two jobs are named 'x.svg'");
    refused("[[item]]\npattern = 'hilbert'\n[[item]]\npattern = 'hilbert'\n",
            "gallery.toml:3:1: two jobs are named 'hilbert.svg' (the other: gallery.toml:1:1)");
    refused("pattern = 'hilbert'\nn = '1:1000000000'\n", "this would make 1000000000 jobs");
    refused("pattern = 'hilbert'\nset = { a = '0:1:1e-300', b = '1:1000000' }\n", "jobs; at most");
    refused(
        "pattern = 'hilbert'\n"
        "palette = 'rad'\n",
        "gallery.toml:2:1: ");
    refused(
        "pattern = 'hilbert'\n"
        "n = [1, 2]\nvariant = 'nope'\n",
        "gallery.toml:3:1: ");
    refused(
        "pattern = 'hilbert'\n"
        "set = { 'angel increment' = 3 }\n",
        "gallery.toml:2:9: ");
    refused(
        "pattern = 'hilbert'\n"
        "set = { 'angle increment' = [60, 'x'] }\n",
        "gallery.toml:2:9: ");
    refused(
        "pattern = 'hilbert'\n"
        "angle = ['60:70:5', 'x']\n",
        "gallery.toml:2:1: ");
    refused(
        "pattern = 'hilbert'\n"
        "budget = -4\n",
        "gallery.toml:2:1: budget: expected 1 or more, not '-4'");
    refused(
        "pattern = 'hilbert'\n"
        "compression = 77\n",
        "gallery.toml:2:1: compression: expected 1 to 9, not '77'");
    refused(
        "pattern = 'hilbert'\n"
        "bars = 0\n",
        "gallery.toml:2:1: bars: expected 1 or more");
    refused(
        "pattern = 'hilbert'\n"
        "n = '3:-2:-1'\n",
        "gallery.toml:2:1: n: expected whole numbers");
    refused(
        "pattern = 'hilbert'\n"
        "fit = true\nstep = '1mm'\n",
        "gallery.toml:3:1: step: cannot be combined with 'fit'");
    refused(
        "pattern = 'hilbert'\n"
        "item = []\n",
        "gallery.toml:2:1: item: this list is empty");
    refused(
        "pattern = 'hilbert'\n"
        "poster = '3x'\n",
        "gallery.toml:2:1: poster 3x");
    refused(
        "pattern = 'hilbert'\n"
        "name = 'a//x'\n",
        "cannot be the name");
    refused(
        "pattern = 'hilbert'\n"
        "name = \"a\\nx\"\n",
        "cannot be the name");
    refused(
        "pattern = 'hilbert'\n"
        "n = '0:1e300'\n",
        "this would make 1e+300 jobs");
    const auto refused_line = [](const std::string& text, std::string_view message) {
        GalleryRequest request;
        request.manifest = "bad.jsonl";
        request.manifest_text = text;
        request.bundled_only = true;
        EXPECT_TRUE(has(error_of<GalleryError>([&] { gallery_jobs(request, keys()); }), message));
    };
    refused_line("{\"pattern\": \"hilbert\"}\n{\"pattern\": \"hilbert\", \"nn\": 3}\n",
                 "bad.jsonl:2:24: unknown key 'nn'");
    refused_line("{\"pattern\": }\n", "bad.jsonl:1:13: invalid JSON");
    refused_line(std::string(200'000, '['), "bad.jsonl:1:51: too many brackets in each other");
    refused_line("{\"pattern\":\"hilbert\",\"dpi\":1e400}", "bad.jsonl:1:");
    refused_line("{\"pattern\":\"hilbert\",\"n\":1,\"n\":2}", "bad.jsonl:1:28: duplicate key 'n'");
}

}  // namespace sikku::gallery_keys_test
