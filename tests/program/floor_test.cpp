// tests/program/floor_test.cpp: uses documents, interpreters and their tables like a caller of the libraries.
#include "art/analysis.h"
#include "art/gallery/gallery.h"
#include "art/gallery/jobs.h"
#include "art/gallery/keys.h"
#include "art/gallery/values.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "engine/language/document.h"
#include "music/scores.h"
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

namespace sikku::floor_test {

const char* const koch = "title: Koch\naxiom: F\nF --> F-F++F-F\nangle factor: 6\nderivation length: 3\n";

TEST(Floor, PrintsAndScoresInMemoryEqualThoseOfTheProgram) {
    const ScratchFolder folder;
    const Document hilbert = load("hilbert");
    for (const char* format : {"svg", "pdf", "png", "hpgl", "gcode", "tif", "glb"}) {
        const std::string file = folder.file(std::string("a.") + format);
        ASSERT_EQ(run({"draw", "hilbert", "--size", "60x60mm", "--dpi", "40", "-o", file}).status, 0) << format;
        OptionValues values = {{"size", "60x60mm"}, {"dpi", "40"}};
        EXPECT_TRUE(draw(hilbert, format, values) == contents(file)) << format;
    }
    for (const char* format : {"mid", "musicxml", "ly", "html", "svg"}) {
        const std::string file = folder.file(std::string("b.") + format);
        ASSERT_EQ(run({"play", "hilbert", "--scale", "dorian", "--bars", "4", "-o", file}).status, 0) << format;
        EXPECT_TRUE(play(hilbert, format, {{"scale", "dorian"}, {"bars", "4"}}) == contents(file)) << format;
    }
}

TEST(Floor, KeysAndDefinesOfThePatternMayStandAmongTheOptions) {
    const Document document = parse("koch", koch);
    const std::string navy = draw(document, "svg", {{"size", "A6"}, {"stroke", "0.3mm navy"}});
    EXPECT_TRUE(has(navy, "#000080"));
    EXPECT_NE(navy, draw(document, "svg", {{"size", "A6"}}));
    EXPECT_THROW(draw(document, "svg", {{"strokes", "0.3mm navy"}}), SettingError);
}

TEST(Floor, SettingsOfAnInterpreterKeepTheGrammar) {
    const Document document = parse("koch", koch);
    EXPECT_EQ(document.with({{"test", "stroke", "1mm"}}).shared_grammar(), document.shared_grammar());
    EXPECT_EQ(document.with({{"test", "tempo", "90"}}).shared_grammar(), document.shared_grammar());
    const Document longer = document.with({{"test", "derivation length", "4"}});
    EXPECT_NE(longer.shared_grammar(), document.shared_grammar());
    EXPECT_EQ(longer.grammar().steps(), 4);
    EXPECT_EQ(document.grammar().steps(), 3);
    EXPECT_TRUE(longer.has_override("derivation length"));
    EXPECT_THROW(document.with({{"test", "derivation length", "x"}}), PatternError);
}

TEST(Floor, AWorkKnowsWhatItCostsAndWhatItReads) {
    const ScratchFolder folder;
    folder.write("own.scl", "! own.scl\n!\nOwn\n 2\n!\n 600.0\n 2/1\n");
    const Document document = parse("koch", koch);
    const auto work = scores().plan(document, "mid", {{"scale", "own.scl"}}, folder.path());
    ASSERT_EQ(work->read_files().size(), 1U);
    EXPECT_EQ(work->read_files().front().first, "own.scl");
    const Cost small = prints().plan(document, "svg", {})->forecast();
    const Cost large = prints().plan(document.with({{"test", "derivation length", "9"}}), "svg", {})->forecast();
    EXPECT_GT(large.seconds, small.seconds);
    EXPECT_GT(large.bytes, 1000 * small.bytes / 10);
}

TEST(Floor, AStopRequestEndsAWork) {
    const Document document = load("hilbert", {"", {{"test", "derivation length", "11"}}});
    MemoryDestination memory;
    const Monitor stops([](void*) { return true; });
    EXPECT_THROW(prints().plan(document, "svg", {})->make(memory, "a.svg", stops), Stopped);
    EXPECT_TRUE(memory.outputs().empty() || memory.outputs().at("a.svg").empty());
}

TEST(Floor, OutputsInMemoryStopOnRequest) {
    const Document document = load("hilbert", {"", {{"test", "derivation length", "11"}}});
    const Monitor stops([](void*) { return true; });
    EXPECT_THROW(draw(document, "svg", {}, stops), Stopped);
    EXPECT_THROW(play(document, "mid", {}, stops), Stopped);
    EXPECT_THROW(drawn_lines(document, 1e9, stops), Stopped);
    EXPECT_THROW(list_notes(std::span(&document, 1), {}, stops), Stopped);
}

TEST(Floor, ValuesAreSortedByWhatTheySet) {
    const Document document = parse("koch", koch);
    const Assignment assigned = assign(prints(), document, {{"size", "A3"}, {"derivation length", "2"}});
    ASSERT_EQ(assigned.options.size(), 1U);
    EXPECT_EQ(assigned.options.front().name, "size");
    EXPECT_EQ(assigned.document.grammar().steps(), 2);
    EXPECT_THROW(assign(prints(), document, {{"sizes", "A3"}}), SettingError);
    EXPECT_THROW(assign(prints(), document, {{"derivation length", "x"}}), PatternError);
}

/// Sound and printed scores are made by other programs, which may be missing.
TEST(Floor, FormatsOfTextAreText) {
    const Document document = load("hilbert", {"", {{"test", "derivation length", "2"}}});
    const OptionValues small = {{"size", "40x40mm"}, {"dpi", "50"}};
    for (const Interpreter* interpreter : {&prints(), &scores()}) {
        for (const FormatName& format : interpreter->formats()) {
            if (format.is_several || format.label == "sound" || format.label == "printed score") continue;
            const bool is_print = interpreter == &prints();
            const std::string bytes =
                make_in_memory(*interpreter, document, format.extension, is_print ? small : OptionValues());
            const bool has_controls = std::any_of(bytes.begin(), bytes.end(), [](char byte) {
                return byte >= 0 && byte < 32 && byte != '\n' && byte != '\r' && byte != '\t' && byte != 27 &&
                       byte != 3;
            });
            EXPECT_EQ(format.is_text, !has_controls) << format.extension;
        }
    }
}

TEST(Floor, LinesAndNotesAreData) {
    const Document document = load("hilbert");
    const DrawnLines lines = drawn_lines(document, 1e6, {});
    EXPECT_EQ(std::get<0>(lines).points.size(), 1024U);
    EXPECT_EQ(std::get<0>(lines).begins, (std::vector<std::int64_t>{0, 1024}));
    EXPECT_EQ(std::get<1>(drawn_lines(load("bush-3d"), 1e6, {})).begins.front(), 0);
    const NoteList list = list_notes(std::span(&document, 1), {{"bars", "4"}, {"tempo", "90"}}, {});
    EXPECT_EQ(list.tempo, 90);
    EXPECT_EQ(list.end, 4 * list.meter.bar());
    EXPECT_TRUE(std::is_sorted(list.notes.begin(), list.notes.end(),
                               [](const Note& a, const Note& b) { return a.onset < b.onset; }));
    EXPECT_GT(list.notes.size(), 8U);
}

TEST(Floor, NoMessageOfALibraryNamesTheCommandLine) {
    const Document document = parse("koch", koch);
    const std::vector<std::pair<std::string, OptionValues>> wrong = {{"svg", {{"size", "big"}}},
                                                                     {"svg", {{"margin", "-1mm"}}},
                                                                     {"svg", {{"margin", "200mm"}}},
                                                                     {"svg", {{"step", "0"}}},
                                                                     {"svg", {{"fit", "true"}, {"step", "1mm"}}},
                                                                     {"svg", {{"window", "1,2,3"}}},
                                                                     {"svg", {{"rotate", "x"}}},
                                                                     {"svg", {{"border", "gold"}}},
                                                                     {"png", {{"animate", ""}}},
                                                                     {"png", {{"plotter", "true"}}},
                                                                     {"svg", {{"travel", "true"}}},
                                                                     {"gif", {}},
                                                                     {"svg", {{"frames", "true"}}},
                                                                     {"svg", {{"generations", "4:1"}}},
                                                                     {"svg", {{"marks", "true"}}},
                                                                     {"png", {{"dpi", "0"}}},
                                                                     {"png", {{"compression", "12"}}},
                                                                     {"png", {{"cmyk", "inks.icc"}}},
                                                                     {"svg", {{"spot", "Kaavi"}}},
                                                                     {"glb", {{"window", "0,0,1,1"}}},
                                                                     {"svg", {{"tile", "A5"}, {"plotter", "true"}}},
                                                                     {"hpgl", {{"bleed", "3mm"}}},
                                                                     {"svg", {{"landscape", "perhaps"}}},
                                                                     {"svg", {{"size", "A4"}, {"size", "A5"}}}};
    for (const auto& [format, values] : wrong) {
        try {
            prints().plan(document, format, values);
            ADD_FAILURE() << format << " " << (values.empty() ? "" : values.front().name) << " is accepted";
        } catch (const SettingError& error) {
            const std::string message = error.what();
            EXPECT_FALSE(has(message, "--"));
            EXPECT_FALSE(has(message, "\n"));
            EXPECT_FALSE(message.empty());
        }
    }
    EXPECT_THROW(scores().check("mid", {{"tuning", "equal"}}), SettingError);
    EXPECT_THROW(scores().check("mid", {{"from-bar", "0"}}), SettingError);
    EXPECT_THROW(scores().check("doc", {}), SettingError);
}

/// An interpreter of prints with one more option, which is added only to the table.
class ExtendedPrints : public Interpreter {
public:
    ExtendedPrints() {
        const auto own = prints().options();
        options_.assign(own.begin(), own.end());
        options_.push_back(&colour_of_paper);
    }
    KeyOwner owner() const override { return prints().owner(); }
    void check_keys(const Pattern& pattern, Diagnostics& diagnostics) const override {
        prints().check_keys(pattern, diagnostics);
    }
    std::span<const FormatName> formats() const override { return prints().formats(); }
    std::span<const OptionInfo* const> options() const override { return options_; }
    void check(std::string_view format, const OptionValues& values) const override {
        for (const OptionValue& value : values) given.insert(value.name + "=" + value.text);
        prints().check(format, {});
    }
    std::unique_ptr<Work> plan(const Document& document, std::string_view format, const OptionValues&,
                               const std::filesystem::path& folder) const override {
        return prints().plan(document, format, {}, folder);
    }
    mutable std::set<std::string> given;

private:
    static constexpr OptionInfo colour_of_paper = {
        .name = "paper-colour", .help = "colour of the paper", .value = "COLOUR"};
    std::vector<const OptionInfo*> options_;
};

TEST(Floor, AnOptionInTheTableIsAKeyOfGalleryFilesAndOfManifests) {
    const ExtendedPrints extended;
    const GalleryKeys keys({&extended, &scores()});
    ASSERT_NE(keys.find("paper-colour"), nullptr);
    EXPECT_EQ(keys.find("paper-colour")->help, "colour of the paper");
    GalleryRequest toml;
    toml.gallery_file = "gallery.toml";
    toml.gallery_text = "pattern = \"hilbert\"\nformat = \"svg\"\npaper_colour = \"wheat\"\n";
    const std::vector<GalleryJob> jobs = gallery_jobs(toml, keys);
    ASSERT_EQ(jobs.size(), 1U);
    EXPECT_TRUE(extended.given.contains("paper-colour=wheat"));
    GalleryRequest json;
    json.manifest = "jobs.jsonl";
    json.manifest_text = jobs.front().text() + "\n";
    EXPECT_EQ(gallery_jobs(json, keys).front().text(), jobs.front().text());
    EXPECT_TRUE(has(jobs.front().text(), "\"paper-colour\":\"wheat\""));
    GalleryRequest unknown = toml;
    EXPECT_THROW(gallery_jobs(unknown, GalleryKeys({&prints(), &scores()})), GalleryError);
}

TEST(Floor, APatternInSeveralFormatsIsCompiledOnceAndPlannedOncePerOutput) {
    const ScratchFolder folder;
    const GalleryKeys keys({&prints(), &scores()});
    GalleryRequest request;
    request.patterns = {"hilbert", "dragon"};
    request.keys = {{"format", "svg,pdf,mid"}, {"size", "60x60mm"}};
    request.poster = "A4";
    Gallery gallery(request, {.folder = folder.path() / "g", .memory = 1e9, .threads = 2}, keys, {});
    GalleryListener nobody;
    const GalleryResult result = gallery.make(nobody);
    EXPECT_EQ(result.made.size(), 6U);
    EXPECT_TRUE(result.failures.empty());
    EXPECT_TRUE(result.troubles.empty());
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "g" / "poster.pdf"));
    EXPECT_EQ(gallery.jobs().front().documents->compiled(), 2U);
    EXPECT_EQ(gallery.jobs().front().works->planned(), 6U);
}

TEST(Floor, EveryOptionOfTheTablesIsInTheHelp) {
    for (const auto& [command, interpreter] :
         {std::pair<const char*, const Interpreter*>("draw", &prints()), {"play", &scores()}}) {
        const std::string help = run({command, "--help"}).output;
        for (const OptionInfo* option : interpreter->options()) {
            EXPECT_TRUE(has(help, "--" + std::string(option->name))) << option->name;
        }
    }
    const std::string help = run({"gallery", "--help"}).output;
    const GalleryKeys keys({&prints(), &scores()});
    for (const GalleryKey& key : keys.list()) {
        if (!key.is_option) continue;
        EXPECT_TRUE(has(help, "--" + (key.name == "n" ? "generations" : key.name))) << key.name;
    }
}

}  // namespace sikku::floor_test
