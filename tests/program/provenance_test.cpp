// tests/program/provenance_test.cpp: `sikku show` of prints and scores: round trips of the program's own files, and
// untrusted files cost little.
#include "art/provenance/provenance.h"

#include "art/image/image_file.h"
#include "art/print/format.h"
#include "art/prints.h"
#include "engine/base/text.h"
#include "music/scores.h"
#include "tests/damaged_pictures.h"
#include "tests/fuzz/file_targets.h"
#include "tests/print_tools.h"
#include "tests/program.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <string>
#include <thread>
#include <utility>

namespace sikku::provenance_test {

using namespace std::string_literals;

const std::string awkward =
    "\xEF\xBB\xBF"
    "title: கோலம் \"a\" <b> & 'c' \xF0\x9F\x8C\xBC \xC2\xA0\r\naxiom: F /* ]]> (\\) &amp; --> */\n\n\t";

std::string chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const uLong sum = crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
    return big_endian(data.size(), 4) + body + big_endian(sum, 4);
}
std::string png(const std::string& chunks) {
    return "\x89PNG\r\n\x1A\n" + chunk("IHDR", "\0\0\0\1\0\0\0\1\x08\0\0\0\0"s) + chunks + chunk("IDAT", "") +
           chunk("IEND", "");
}
std::string deflated(const std::string& text) {
    std::string packed(compressBound(text.size()), '\0');
    uLongf size = packed.size();
    compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
              text.size(), 1);
    packed.resize(size);
    return packed;
}
std::string repeated(std::size_t count, const std::string& text) {
    std::string result;
    result.reserve(count * text.size());
    for (std::size_t i = 0; i < count; ++i) result += text;
    return result;
}
std::string svg(const std::string& inside) {
    return "<svg xmlns:sikku=\"urn:sikku:print\">" + inside + "</svg>";
}

/// What is wrong with a file of these bytes, or nothing.
std::string refusal(const std::string& bytes) {
    const MemoryFile file(bytes);
    const std::string what = error_of([&] { EXPECT_TRUE(read_provenance(file.path())); });
    if (what.empty()) return what;
    EXPECT_TRUE(what.starts_with(file.path().string() + ": ")) << what;
    return what.substr(file.path().string().size() + 2);
}

/// The pattern in a file of these bytes, if it is read.
std::string pattern_in(const std::string& bytes) {
    return provenance_of(MemoryFile(bytes).path()).value_or(Provenance()).pattern;
}

// --- what the program writes --------------------------------------------------------------------------------------

TEST(Show, EveryFormatGivesThePatternBackByteForByte) {
    const auto padded = [](std::size_t size) {
        std::string text = awkward + "/* ";
        while (text.size() < size) text += "ü கோலம் & < \\ ( ";
        return text + "*/\n";
    };
    const std::string longer = padded(longest_short_text - 100);
    const std::string longest = padded(1'000'000);
    for (const std::string& text : {"axiom: F\n"s, awkward, longer, longest}) {
        const Document source = parse("source.lsys", text, {"", {{"-n", "derivation length", "0"}}});
        for (const std::string format :
             {"svg", "pdf", "eps", "png", "tif", "jpg", "exr", "mid", "musicxml", "mxl", "html"}) {
            const std::string bytes =
                named_format(format) ? draw(source, format, {{"size", "20x20mm"}, {"margin", "1mm"}, {"dpi", "20"}})
                                     : play(source, format, {{"vertical", "voice"}});
            const bool is_kept = text.size() <= longest_short_text || (format != "tif" && format != "jpg");
            EXPECT_TRUE(try_show(bytes).value_or("") == (is_kept ? text : "")) << format << ' ' << text.size();
            if (is_kept && format != "mid") {
                EXPECT_TRUE(provenance_of(MemoryFile(bytes).path()).value().made.starts_with("sikku ")) << format;
            }
        }
    }
}

TEST(Show, FilesGiveThePatternBackWhateverTheirNames) {
    const ScratchFolder folder;
    const std::string source = folder.write("source.lsys", awkward);
    for (const char* name : {"a.pdf", "a.jpg", "a.mid"}) {
        const bool is_score = name == "a.mid"s;
        const std::string file = folder.file(name);
        const Outcome made =
            is_score ? run({"-q", "play", source, "-n", "0", "--vertical", "voice", "-o", file})
                     : run({"-q", "draw", source, "-n", "0", "--size", "20x20mm", "--margin", "1mm", "-o", file});
        ASSERT_EQ(made.status, 0) << name << made.errors;
        std::filesystem::rename(file, folder.file("b.lsys"));
        const Outcome shown = run({"show", folder.file("b.lsys")});
        EXPECT_EQ(shown.status, 0) << name << shown.errors;
        EXPECT_TRUE(shown.output == awkward) << name;
        EXPECT_TRUE(has(shown.errors, "made with sikku ")) << name;
    }
}

TEST(Show, LilyPondFilesGiveThePatternBackLineByLine) {
    const Document source = parse("source.lsys", "title:\tகோலம்\r\n\naxiom: F-F\n// %{ no comment\n");
    EXPECT_EQ(pattern_in(play(source, "ly", {{"n", "0"}, {"vertical", "voice"}})),
              "title: கோலம்\n\naxiom: F-F\n// %{ no comment\n");
    EXPECT_EQ(refusal("\\version \"2.24.0\"\n\n{ c }\n"), "this LilyPond file contains no pattern");
    EXPECT_EQ(refusal("<!DOCTYPE html>\n<pre>a</pre>"), "this HTML page contains no pattern");
    EXPECT_EQ(refusal("<?xml version=\"1.0\"?>\n<score-partwise><part/></score-partwise>"),
              "this MusicXML file contains no pattern");
    EXPECT_EQ(refusal("<score-partwise><miscellaneous-field name=\"made\">a"),
              "this MusicXML file is damaged or truncated");
}

TEST(Show, OtherProgramsAgree) {
    NEEDS("exiftool");
    const ScratchFolder folder;
    const std::string text = "title: x\naxiom: F /* <&> */\n";
    for (const std::string format : {"png", "tif", "jpg", "exr"}) {
        const std::string file = folder.write("a." + format, draw(parse("x", text), format, {{"dpi", "10"}}));
        const std::string tag = format == "png" ? "Description" : format == "exr" ? "Comments" : "ImageDescription";
        EXPECT_EQ(run_tool("exiftool -b -" + tag + " '" + file + "'").text, text) << format;
        EXPECT_EQ(provenance_of(file).value().pattern, text) << format;
        const std::string made = run_tool("exiftool -b -Software '" + file + "'").text;
        EXPECT_EQ(provenance_of(file).value().made, made) << format;
    }
}

TEST(Show, RecipesMakeTheSameBytesAgain) {
    const ScratchFolder folder;
    const std::string program = "'" SIKKU_PROGRAM "' -q ";
    // A model contains the name of its other file.
    for (const char* name : {"first", "again"}) std::filesystem::create_directory(folder.file(name));
    const auto made = [&](const std::string& command, const std::string& arguments, const std::string& name) {
        const std::string whole = program + command + " " + arguments + " -o '" + folder.file(name) + "'";
        const ToolOutcome outcome = run_tool("bash -c " + shell_word(whole));
        EXPECT_TRUE(outcome.ok) << arguments << '\n' << outcome.text;
        return contents(folder.file(name));
    };
    // Runs the stored recipe and compares the bytes.
    const auto check = [&](const std::string& command, const std::string& arguments, const std::string& format) {
        const std::string first = made(command, arguments, "first/x." + format);
        std::string recipe = run({"show", folder.file("first/x." + format)}).errors;
        const std::size_t comma = recipe.find(',');
        ASSERT_TRUE(recipe.starts_with("made with sikku ") && comma != std::string::npos) << recipe;
        recipe.pop_back();  // the line feed
        const std::string pattern = arguments.substr(0, arguments.find(' '));
        EXPECT_TRUE(made(command, pattern + recipe.substr(comma + 1), "again/x." + format) == first) << recipe;
    };
    for (const char* format : {"svg", "pdf", "eps", "png", "gcode"}) {
        check("draw",
              "snake-kolam -n 2 --set 'ground=#123' --dots='2mm gold' --border lotus --size 100x140mm --margin 6mm "
              "--rotate 10 --title-line \"it's one\" --jobs 1 --budget 1e6 --dpi 60",
              format);
        check("draw", "hat --variant turtle --stroke '0.3mm navy' --size A6 --dpi 50", format);
    }
    const std::string framed =
        folder.write("framed.lsys", "axiom: F-F-F-F\nangle factor: 4\nborder: kaavi\nderivation length: 1\n");
    check("draw", framed + " --size A6 --border none", "svg");
    check("draw", framed + " --set border=rope --border lotus --size A6 --title-line 'x --seed 5 --generations 3'",
          "svg");
    check("draw",
          framed + " --size A6 --title-line 'Kolam' --title-size 6mm --title-weight 0.3mm --title-place above,right",
          "pdf");
    if (std::filesystem::exists("/usr/share/fonts/truetype/noto/NotoSerif-Bold.ttf")) {
        check("draw", framed + " --size A6 --title-line 'Kolam' --font 'Noto Serif:bold'", "svg");
    }
    check("draw", framed + " --profile marlin --gcode-start $'G0 X1\\nM3 \\'a\\''", "gcode");
    for (const char* format : {"hpgl", "dxf"}) check("draw", "bag-of-candies --rotate 30", format);
    check("draw", "hat", "obj");
    check("draw", "stochastic-branches --seed 7 --no-icc --size 40x40mm --dpi 60", "png");
    check("draw", "hilbert --generations 1:3 --size 40x40mm --dpi 60", "gif");
    for (const char* format : {"mid", "musicxml", "ly"}) {
        check("play",
              "hilbert -n 4 --set tonic=D4 --tempo 90 --scale kalyani --from-bar 2 --bars 4 --humanise 0.4 --seed 3",
              format);
        check("play", "canon --bars 2 --transpose 3", format);
    }
}

// --- what others write --------------------------------------------------------------------------------------------

TEST(Show, PngTextsOfEveryKind) {
    const std::string text = "axiom: F # கோலம்\n";
    EXPECT_EQ(pattern_in(png(chunk("tEXt", "Description\0"s + text))), text);
    EXPECT_EQ(pattern_in(png(chunk("zTXt", "Description\0\0"s + deflated(text)))), text);
    EXPECT_EQ(pattern_in(png(chunk("iTXt", "Description\0\0\0ta\0x\0"s + text))), text);
    EXPECT_EQ(pattern_in(png(chunk("iTXt", "Description\0\1\0\0\0"s + deflated(text)))), text);
    EXPECT_EQ(pattern_in(png(chunk("tEXt", "Title\0axiom: G"s) + chunk("tEXt", "Description\0"s + text))), text);
    const std::string damaged = "this PNG file is damaged or truncated";
    EXPECT_EQ(refusal(png(chunk("zTXt", "Description\0\0garbage"s))), damaged);
    EXPECT_EQ(refusal(png(chunk("zTXt", "Description\0\0"s + deflated(text).substr(0, 12)))), damaged);
    EXPECT_EQ(refusal(png(chunk("zTXt", "Description\0\1"s + deflated(text)))), damaged);
    EXPECT_EQ(refusal(png(chunk("iTXt", "Description\0\0\0ta"s))), damaged);
    std::string wrong = png(chunk("tEXt", "Description\0"s + text));
    wrong[wrong.find("axiom")] ^= 1;
    EXPECT_EQ(refusal(wrong), damaged) << "its checksum is wrong";
    EXPECT_EQ(refusal(png("")), "this PNG file contains no pattern");
    EXPECT_EQ(refusal(png(chunk("tEXt", "Software\0x"s))), "this PNG file contains no pattern");
}

TEST(Show, SvgsThatOthersSaved) {
    const auto pattern = [](const std::string& inside) { return pattern_in(svg(inside)); };
    const std::string made = "<metadata id='m'>\n <x/><sikku:made>y</sikku:made></metadata>";
    EXPECT_EQ(pattern("<desc>a</desc>" + made), "a");
    EXPECT_EQ(pattern(made + "<g><desc>no</desc></g><desc id=\"d>\">a</desc>"), "a");
    EXPECT_EQ(pattern("<!-- <desc>b</desc> --><desc>&lt;&#x41;&#66;&amp;lt;&nbsp;&#xD800;&</desc>" + made),
              "<AB&lt;&nbsp;&#xD800;&");
    EXPECT_EQ(pattern("<desc>a\r\nb\rc&#13;\n<![CDATA[<&]]]>x]]></desc>" + made), "a\nb\nc\r\n<&]x]]>");
    EXPECT_EQ(refusal(svg("<desc>no</desc><metadata><sikku:made/><sikku:pattern>61g0</sikku:pattern></metadata>")),
              "this SVG file is damaged or truncated");
    EXPECT_EQ(pattern("<desc>no</desc><metadata><sikku:made/><sikku:pattern>610a</sikku:pattern></metadata>"), "a\n");
    EXPECT_EQ(refusal(svg("<desc>a</desc><metadata></metadata>")), "this SVG file contains no pattern");
    EXPECT_EQ(refusal("<svg><desc>a</desc>" + made + "</svg>"), "this SVG file contains no pattern");
    EXPECT_EQ(refusal("<svg xmlns:sikku=\"urn:sikku:print\"><desc>a"), "this SVG file is damaged or truncated");
}

TEST(Show, WhatMadeAPrintReachesTheTerminalAsPlainText) {
    const auto file = std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/show/made-escape.svg";
    const Outcome shown = run({"show", file.string()});
    EXPECT_FALSE(has(shown.errors, "\x1B"));
    EXPECT_FALSE(has(shown.errors, "\a"));
    EXPECT_TRUE(has(shown.errors, "made with "));
    EXPECT_EQ(json_string("a\n\x1B\x7F\xC2\x9B\xC2\xA0\xE2\x80\xA8\xE2\x80\xA9\xE2\x80\xAA\"\\ü"),
              "\"a\\u000a\\u001b\\u007f\\u009b\xC2\xA0\\u2028\\u2029\xE2\x80\xAA\\\"\\\\ü\"");
    // A title with the introducer of control sequences in one character.
    const std::string pattern =
        "title: a\xC2\x9B"
        "31m\naxiom: F\n";
    for (const char* option : {"--json", "-q"}) {
        const Outcome measured = run({"measure", "-", option}, {.input = pattern});
        EXPECT_EQ(measured.status, 0);
        EXPECT_FALSE(has(measured.output, "\x9B"));
    }
}

// --- bombs --------------------------------------------------------------------------------------------------------

class ShowBombs : public ::testing::Test {
protected:
    /// Shows a file and expects status and message; the file is small to read whatever it states.
    void expect(const std::string& name, std::string bytes, int status, const std::string& message) {
        const std::string file = folder_.write(name, bytes);
        std::string().swap(bytes);  // the memory of this process counts as that of its children
        expect_file(file, status, message);
    }
    void expect_file(const std::string& file, int status, const std::string& message) {
        const Outcome outcome = run({"show", file}, {.output = "/dev/null"});
        EXPECT_EQ(outcome.status, status) << file << ": " << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
        if (!sanitized) {
            EXPECT_LT(outcome.peak, 200 * 1024) << file;
            EXPECT_LT(outcome.seconds, 5.0) << file;
        }
    }
    const std::string too_long = "more than 64 MB";
    const std::string nothing = "contains no pattern";
    const std::string damaged = "is damaged or truncated";
    ScratchFolder folder_;
};

TEST_F(ShowBombs, OfTheCorpus) {
    const auto corpus = std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/show";
    for (const char* name : {"gif-null-write.png", "gif-2GB.png", "progressive-25GB.jpg", "exr-memory.exr"}) {
        const Outcome outcome = run({"show", (corpus / name).string()});
        EXPECT_EQ(outcome.status, 1) << name << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, std::string(name) + ": this "));
        EXPECT_LT(outcome.peak, sanitized ? 1'000'000 : 50'000) << name << ": OpenImageIO alone takes 120 MB";
    }
}

TEST_F(ShowBombs, Png) {
    const std::string packed = deflated(std::string(100 << 20, 'A'));
    expect("a.png", png(chunk("zTXt", "Description\0\0"s + packed)), 1, too_long);
    const std::string other = chunk("zTXt", "Comment\0\0"s + deflated(std::string(8 << 20, 'A')));
    expect("b.png", png(repeated(990, other)), 1, nothing);
    expect("c.png", png(repeated(3'000'000, chunk("tEXt", ""))), 1, nothing);
    expect("d.png", png(chunk("iCCP", "x\0\0"s + packed)), 1, nothing);
    // A chunk that states 2 GB.
    expect("e.png", png("\x7F\xFF\xFF\xFFtEXtDescription\0axiom: F"s), 1, too_long);
    expect("f.png", png("\0\x80\0\0tEXtDescription\0axiom: F"s), 1, damaged);
    expect("g.png", "\x89PNG\r\n\x1A\n"s, 1, damaged);
}

TEST_F(ShowBombs, TiffJpegAndExr) {
    const auto tiff = [](const std::string& entries, std::size_t count) {
        return "II*\0"s + little_endian(8, 4) + little_endian(count, 2) + entries + little_endian(0, 4);
    };
    const std::string long_text =
        little_endian(270, 2) + little_endian(2, 2) + little_endian(0xFFFFFFFF, 4) + little_endian(8, 4);
    expect("a.tif", tiff(long_text, 1), 1, too_long);
    expect("b.tif", tiff(long_text, 65'535), 1, damaged);
    expect("c.tif", "II*\0\xFF\xFF\xFF\xFF"s, 1, damaged);
    expect("d.tif", "II+\0\x08\0\0\0"s + little_endian(16, 8) + std::string(8, '\xFF'), 1, damaged);
    const std::string there =
        little_endian(270, 2) + little_endian(2, 2) + little_endian(60 << 20, 4) + little_endian(8, 4);
    expect("e.tif", tiff(repeated(60'000, there), 60'000) + std::string(64 << 20, 'x'), 0, "");
    expect("a.jpg", "\xFF\xD8" + repeated(5'000'000, "\xFF\xE5\0\2"s), 1, nothing);
    expect("b.jpg", "\xFF\xD8" + std::string(1 << 20, '\xFF'), 1, nothing);
    expect("c.jpg",
           "\xFF\xD8\xFF\xE1\0\x40"
           "Exif\0\0II*\0\xFF\xFF\xFF\xFF"s,
           1, damaged);
    expect("d.jpg", "\xFF\xD8\xFF\xE1\0\1"s, 1, damaged);
    const std::string exr = "v/1\1\2\0\0\0"s;
    expect("a.exr", exr + "comments\0string\0\xFF\xFF\xFF\x7F"s, 1, too_long);
    expect("b.exr", exr + "comments\0string\0\0\0\0\1"s, 1, damaged);
    expect("c.exr", exr + repeated(5'000'000, "a\0b\0\0\0\0\0"s), 1, nothing);
    expect("d.exr", exr + std::string(1 << 20, 'a'), 1, damaged);
}

TEST_F(ShowBombs, SvgAndPdf) {
    const std::string made = "<metadata><sikku:made>x</sikku:made></metadata>";
    expect("a.svg", svg("<desc>" + std::string(60 << 20, 'x') + "</desc>" + made), 0, "");
    expect("b.svg", svg("<desc>" + std::string(70 << 20, 'x') + "</desc>" + made), 1, too_long);
    expect("c.svg", svg("<desc>" + repeated(2 << 20, "&quot;") + "</desc>" + made), 0, "");
    expect("d.svg", svg(repeated(4 << 20, "<a>")), 1, damaged);
    expect("e.svg", svg("<a " + repeated(4 << 20, "\"\"")), 1, damaged);
    expect("f.svg", svg("<desc>" + std::string(8 << 20, '&') + "</desc>" + made), 0, "");
    expect("g.svg", svg("<desc><![CDATA[" + std::string(8 << 20, ']') + "]]></desc>" + made), 0, "");
    const std::string sparse = folder_.write("h.svg", "<svg xmlns:sikku=\"urn:sikku:print\">");
    std::filesystem::resize_file(sparse, std::uintmax_t{2} << 30);
    expect_file(sparse, 1, damaged);

    const auto xml = [](const std::string& pattern) {
        return "<score-partwise><miscellaneous-field name=\"made\">x</miscellaneous-field><miscellaneous-field "
               "name=\"pattern\">" +
               pattern + "</miscellaneous-field>";
    };
    expect("a.musicxml", xml(std::string(60 << 20, 'x')), 0, "");
    expect("b.musicxml", xml(std::string(70 << 20, 'x')), 1, too_long);
    expect("c.musicxml", xml(std::string(8 << 20, '&')), 0, "");
    const std::string lilypond = "\\version \"2.24.0\"\n\n% sikku 1\n";
    expect("a.ly", lilypond + repeated(16 << 20, "%\n"), 0, "");
    expect("b.ly", lilypond + "%" + std::string(70 << 20, 'x') + "\n", 1, too_long);

    const auto pdf = [](std::string texts) {
        const std::string object = "%PDF-1.4\n1 0 obj\n<< " + std::move(texts) + " /Creator (Sikku) >>\nendobj\n";
        return object +
               "xref\n0 2\n0000000000 65535 f \n0000000009 00000 n \ntrailer\n<< /Size 2 /Root 1 0 R /Info 1 0 R "
               ">>\n" +
               "startxref\n" + std::to_string(object.size()) + "\n%%EOF\n";
    };
    EXPECT_EQ(pattern_in(pdf("/SikkuPattern (a\\(\\163)")), "a(s");
    expect("a.pdf", pdf("/SikkuPattern (" + std::string(60 << 20, 'x') + ")"), 0, "");
    expect("b.pdf", pdf("/SikkuPattern (" + std::string(70 << 20, 'x') + ")"), 1, too_long);
    expect("c.pdf", pdf("/SikkuPattern <FEFF" + repeated(20 << 20, "0041") + ">"), 0, "");
    expect("d.pdf", pdf("/Title <" + std::string(100 << 20, '4') + ">\n/SikkuPattern (a)"), 0, "");
    expect("e.pdf", pdf(repeated(2 << 20, "/A () ")), 1, nothing);
    expect("f.pdf", pdf("/SikkuPattern " + std::string(8 << 20, '(')), 1, nothing);
    const std::string end = "xref\n0 1\ntrailer\n<< /Info 1 0 R >>\nstartxref\n";
    expect("g.pdf", "%PDF-" + end + "0\n%%EOF", 1, nothing);
}

TEST_F(ShowBombs, Midi) {
    const std::string header = "MThd\0\0\0\6\0\1\0\1\1\xE0"s;
    const auto track = [](const std::string& events) { return "MTrk" + big_endian(events.size(), 4) + events; };
    const std::string text = "\0\xFF\1\5axiom"s, end = "\0\xFF\x2F\0"s;
    // 15 million events after the text, of two bytes each.
    const std::string events = text + "\0\xC0\0"s + std::string(30'000'000, '\0') + end;
    expect("a.mid", header + track(events), 0, "");
    expect("b.mid", header + track(events.substr(text.size())), 1, nothing);
    // Written by separate statements: memory held by the arguments of a call would count, too.
    const std::string over = "\0\xFF\1\xA3\x80\x80\0"s, most = "\0\xFF\1\xA0\x80\x80\0"s;
    const std::string too_much = folder_.write("c.mid", header + track(over + std::string(70 << 20, 'x') + end));
    expect_file(too_much, 1, damaged);
    const std::string just_enough = folder_.write("d.mid", header + track(most + std::string(64 << 20, 'x') + end));
    expect_file(just_enough, 0, "");
    expect("e.mid", header + "MTrk\xFF\xFF\xFF\xFF"s, 1, damaged);
    const Outcome checked = run({"check", folder_.file("a.mid")});
    EXPECT_EQ(checked.status, 0) << checked.output;
    if (!sanitized) {
        EXPECT_LT(checked.peak, 100 * 1024);
    }
    // All keys of all channels sound in many tracks.
    std::string keys;
    for (int channel = 0; channel < 16; ++channel) {
        for (int key = 0; key < 128; ++key) {
            keys += '\0';
            keys += static_cast<char>(0x90 | channel);
            keys += static_cast<char>(key);
            keys += '\1';
        }
    }
    const std::string sounding = folder_.write("f.mid", header + repeated(2'000, track(keys + end)));
    const Outcome sounded = run({"check", sounding});
    EXPECT_EQ(sounded.status, 1);
    if (!sanitized) {
        EXPECT_LT(sounded.peak, 100 * 1024);
    }
    const std::string sparse = folder_.write("g.mid", header);
    std::filesystem::resize_file(sparse, std::uintmax_t{2} << 30);
    const Outcome refused = run({"check", sparse});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.errors, "more than 128 MB"));
    if (!sanitized) {
        EXPECT_LT(refused.peak, 300 * 1024);
    }
    expect_file(sparse, 1, damaged);
}

TEST_F(ShowBombs, PatternsDevicesAndPipes) {
    expect("a.lsys", std::string(60 << 20, '\n'), 0, "");
    expect("b.lsys", repeated(7 << 20, "F --> FF\n"), 0, "");
    expect("c.lsys", repeated(7 << 20, "/* */ F\n"), 0, "");
    expect("d.lsys", std::string(65 << 20, '\n'), 2, "64 MB");
    expect("e.png", "\x89PNX", 2, "UTF-8");
    expect_file("/dev/zero", 2, "64 MB");
    expect_file(folder_.file("missing.png"), 2, "No such file");
    expect_file(folder_.path().string(), 2, "is a folder");
    // A link to a device that is named like a print.
    std::filesystem::create_symlink("/dev/zero", folder_.path() / "zero.png");
    expect_file(folder_.file("zero.png"), 2, "64 MB");
    ASSERT_EQ(::mkfifo(folder_.file("pipe").c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(folder_.file("pipe")) << "axiom: F\n"; });
    EXPECT_EQ(run({"show", folder_.file("pipe")}).output, "axiom: F\n");
    writer.join();
}

}  // namespace sikku::provenance_test
