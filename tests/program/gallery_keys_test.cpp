// tests/program/gallery_keys_test.cpp: which options of single works are keys of galleries.
#include "art/gallery/jobs.h"
#include "art/gallery/values.h"
#include "art/prints.h"
#include "engine/base/output.h"
#include "music/scores.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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

}  // namespace sikku::gallery_keys_test
