// tests/art/pdf_x_test.cpp: PDF/X-4 as independent readers see it: qpdf, poppler, Ghostscript, libxml2 and pugixml.
#include "art/prints.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/print_tools.h"
#include "tests/tools.h"

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <regex>
#include <string>

namespace sikku::pdf_x_test {

constexpr const char* profile = "/usr/share/color/icc/ghostscript/default_cmyk.icc";

const std::string kolam =
    "title: A <kolam> & more\naxiom: F+XF+F+XF\nX --> XF-F-F+XF+F+XF-F-F+X\nderivation length: 1\nangle increment: "
    "90\n"
    "stroke: 3mm #000000\nground: #ffcc33\nfill: #30a050\n";

class PdfX : public ::testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(profile)) GTEST_SKIP() << profile << " is not installed";
    }

    std::filesystem::path write(OptionValues values, const std::string& pattern = kolam,
                                const std::string& name = "x.pdf") {
        values.push_back({"cmyk", profile});
        values.push_back({"size", "100x100mm"});
        return folder_.write(name, draw(parse("x.lsys", pattern), "pdf", values));
    }
    /// Mean ink on a plate as Ghostscript separates it, 0 to 1.
    double ink(const std::filesystem::path& pdf, const std::string& plate) {
        const std::string stem = (folder_ / pdf.stem().string()).string();
        if (!std::filesystem::exists(stem + ".tif")) {
            const ToolOutcome outcome = run_tool("gs -q -dNOPAUSE -dBATCH -dSAFER -sDEVICE=tiffsep -r50 -o '" + stem +
                                                 ".tif' '" + pdf.string() + "'");
            EXPECT_TRUE(outcome.ok) << outcome.text;
        }
        const PixelGrid pixels = read_by_oiiotool(stem + "(" + plate + ").tif", "0,0,0");
        double sum = 0;
        for (const char byte : pixels.bytes) sum += 255 - static_cast<unsigned char>(byte);
        return sum / 255 / static_cast<double>(pixels.bytes.size());
    }

    ScratchFolder folder_;
};

TEST_F(PdfX, SaysWhatItIs) {
    NEEDS("qpdf");
    NEEDS("pdfinfo");
    const auto path = write({{"bleed", "3mm"}, {"marks", "true"}});
    const std::string text = plain_text(path);
    EXPECT_TRUE(contents(path).starts_with("%PDF-1.6"));
    for (const char* part : {"/OutputIntents", "/GTS_PDFX", "/DestOutputProfile", "/OutputConditionIdentifier",
                             "/Trapped /False", "/TrimBox", "/BleedBox", "/Metadata", "/ID "}) {
        EXPECT_TRUE(has(text, part)) << part;
    }
    // What the standard forbids or does not need.
    for (const char* part : {"/ArtBox", "/AS ", "/JavaScript", "/Annots", "/Encrypt", "/Font"}) {
        EXPECT_FALSE(has(text, part)) << part;
    }
    const ToolOutcome info = run_tool("pdfinfo -box '" + path.string() + "'");
    EXPECT_TRUE(has(info.text, "PDF subtype:    PDF/X-4"));
    // 100 mm are 283.46 points; bleed and marks take 8 mm.
    EXPECT_TRUE(has(info.text, "TrimBox:            22.68    22.68   306.14   306.14"));
    EXPECT_TRUE(has(info.text, "BleedBox:           14.17    14.17   314.65   314.65"));
}

TEST_F(PdfX, MetadataAndInformationAgree) {
    NEEDS("pdfinfo");
    const auto path = write({});
    const std::string packet = run_tool("pdfinfo -meta '" + path.string() + "'").text;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(packet.c_str())) << packet;
    const pugi::xml_node about = document.child("x:xmpmeta").child("rdf:RDF").child("rdf:Description");
    const auto value = [&](const char* name) { return std::string(about.child_value(name)); };
    EXPECT_EQ(value("pdfxid:GTS_PDFXVersion"), "PDF/X-4");
    EXPECT_EQ(value("pdf:Trapped"), "False");
    EXPECT_EQ(value("xmpMM:VersionID"), "1");
    EXPECT_EQ(value("xmpMM:RenditionClass"), "default");
    static const std::regex uuid("uuid:[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}");
    EXPECT_TRUE(std::regex_match(value("xmpMM:DocumentID"), uuid)) << value("xmpMM:DocumentID");
    EXPECT_STREQ(about.child("dc:title").child("rdf:Alt").child_value("rdf:li"), "A <kolam> & more");
    for (const char* date : {"xmp:CreateDate", "xmp:ModifyDate", "xmp:MetadataDate"}) {
        EXPECT_EQ(value(date), "2010-01-01T00:00:00Z") << "the same on every day";
    }
    const std::string info = run_tool("pdfinfo -isodates '" + path.string() + "'").text;
    EXPECT_TRUE(has(info, "Title:           A <kolam> & more"));
    EXPECT_TRUE(has(info, "CreationDate:    2010-01-01T00:00:00Z"));
    EXPECT_TRUE(has(info, "ModDate:         2010-01-01T00:00:00Z"));
    // Other drawings are other documents, equal ones are the same.
    EXPECT_EQ(contents(path), contents(write({}, kolam, "again.pdf")));
    const auto id = [&](const std::filesystem::path& file) {
        const std::string all = contents(file);
        return all.substr(all.rfind("/ID ["), 70);
    };
    EXPECT_NE(id(path), id(write({{"rotate", "1"}}, kolam, "other.pdf")));
    EXPECT_NE(id(path), id(write({}, "// another text\n" + kolam, "text.pdf")));
}

TEST_F(PdfX, TheProfileIsTheOneGiven) {
    NEEDS("qpdf");
    const auto path = write({});
    const std::string text = plain_text(path);
    static const std::regex reference(R"(/DestOutputProfile (\d+) 0 R)");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(text, match, reference));
    const std::string icc = folder_.file("out.icc");
    ASSERT_TRUE(run_tool("qpdf --show-object=" + match[1].str() + " --filtered-stream-data '" + path.string() +
                         ".plain' > '" + icc + "'")
                    .ok);
    EXPECT_EQ(contents(icc), contents(profile));
}

TEST_F(PdfX, EveryColourIsAnInk) {
    NEEDS("qpdf");
    const std::string tree =
        "title: T\naxiom: {F+F+F+F}@O(2)F\nangle increment: 90\nstroke: 1mm #20306080\nfill: #30a05080\n"
        "ground: #ffffff80\n";
    std::vector<std::filesystem::path> files = {
        write({{"bleed", "3mm"}, {"marks", "true"}, {"registration", "true"}, {"border", "kaavi"}, {"dots", ""}}),
        write({{"spot", "Sun=#ffcc33"}, {"marks", "true"}}, kolam, "spot.pdf"),
        write({}, tree, "alpha.pdf"),
        write({{"generations", "0:2"}}, kolam, "sheet.pdf"),
        write({{"tile", "60x60mm"}}, kolam, "tiles.pdf"),
        write({{"plotter", "true"}, {"travel", "true"}}, kolam, "plot.pdf")};
    for (const auto& path : files) {
        const std::string text = plain_text(path);
        EXPECT_FALSE(has(text, "DeviceRGB")) << path;
        static const std::regex rgb(R"([0-9.]+ [0-9.]+ [0-9.]+ (rg|RG)\b)");
        EXPECT_FALSE(std::regex_search(text, rgb)) << path;
        static const std::regex cmyk(R"([0-9.]+ [0-9.]+ [0-9.]+ [0-9.]+ [kK]\b)");
        EXPECT_TRUE(std::regex_search(text, cmyk)) << path;
        EXPECT_TRUE(has(text, "GTS_PDFX")) << path;
        const auto provenance = provenance_of(path);
        EXPECT_TRUE(provenance && provenance->pattern.find("angle increment") != std::string::npos) << path;
    }
}

TEST_F(PdfX, BlackLinesAreBlackInkAlone) {
    NEEDS("gs");
    NEEDS("oiiotool");
    const std::string lines = "title: T\naxiom: F+F+F+F\nangle increment: 90\nstroke: 5mm #000000\n";
    const auto path = write({}, lines);
    EXPECT_GT(ink(path, "Black"), 0.05);
    for (const char* plate : {"Cyan", "Magenta", "Yellow"}) EXPECT_EQ(ink(path, plate), 0) << plate;
    // A black ground is as deep as the press prints it.
    const auto ground = write({}, "title: T\naxiom: F\nstroke: 1mm #ffffff\nground: #000000\n", "ground.pdf");
    for (const char* plate : {"Cyan", "Magenta", "Yellow", "Black"}) EXPECT_GT(ink(ground, plate), 0.2) << plate;
}

TEST_F(PdfX, BlackPrintsOverOtherInksIfRequested) {
    NEEDS("gs");
    NEEDS("oiiotool");
    const std::string lines = "title: T\naxiom: F+F+F+F\nangle increment: 90\nstroke: 5mm #000000\nground: #ffcc33\n";
    const auto knocked_out = write({}, lines, "knocked.pdf");
    const auto over = write({{"overprint", "black"}}, lines, "over.pdf");
    const auto spots = write({{"overprint", "spots"}}, lines, "spots.pdf");
    // Without a hole under the lines the ground is whole.
    const auto ground = write({}, "title: T\naxiom: F\nstroke: 5mm #ffcc33\nground: #ffcc33\n", "ground.pdf");
    EXPECT_NEAR(ink(over, "Yellow"), ink(ground, "Yellow"), 1e-4);
    EXPECT_LT(ink(knocked_out, "Yellow"), 0.95 * ink(ground, "Yellow"));
    EXPECT_NEAR(ink(spots, "Yellow"), ink(knocked_out, "Yellow"), 1e-4);
    EXPECT_NEAR(ink(over, "Black"), ink(knocked_out, "Black"), 1e-4);
}

TEST_F(PdfX, SpotColoursPrintOverOtherInksIfRequested) {
    NEEDS("gs");
    NEEDS("oiiotool");
    const std::string lines = "title: T\naxiom: F+F+F+F\nangle increment: 90\nstroke: 5mm #b3452c\nground: #ffcc33\n";
    const auto knocked_out = write({{"spot", "Kaavi=#b3452c"}}, lines, "knocked.pdf");
    const auto over = write({{"spot", "Kaavi=#b3452c"}, {"overprint", "spots"}}, lines, "over.pdf");
    EXPECT_GT(ink(over, "Yellow"), 1.03 * ink(knocked_out, "Yellow"));
    EXPECT_NEAR(ink(over, "Kaavi"), ink(knocked_out, "Kaavi"), 1e-4);
    EXPECT_GT(ink(over, "Kaavi"), 0.05);
}

TEST_F(PdfX, RegistrationMarksAreOnEveryPlate) {
    NEEDS("gs");
    NEEDS("oiiotool");
    const std::string lines = "title: T\naxiom: F\nstroke: 1mm #000000\n";
    const auto without = write({}, lines, "without.pdf");
    const auto with = write({{"registration", "true"}}, lines, "with.pdf");
    for (const char* plate : {"Cyan", "Magenta", "Yellow"}) {
        EXPECT_EQ(ink(without, plate), 0) << plate;
        EXPECT_GT(ink(with, plate), 1e-4) << plate;
    }
}

TEST_F(PdfX, OtherProfilesAreRefused) {
    const std::string text = contents(profile);
    const auto refused = [&](const std::string& bytes) -> std::string {
        const std::string file = folder_.write("other.icc", bytes);
        return error_of<std::runtime_error>([&] { draw(parse("x.lsys", kolam), "pdf", {{"cmyk", file}}); });
    };
    EXPECT_TRUE(has(refused("nothing"), "not an ICC profile"));
    std::string link = text;
    link.replace(12, 4, "spac");  // the class of the profile
    EXPECT_TRUE(has(refused(link), "not that of an output device"));
    EXPECT_EQ(refused(text), "");
}

}  // namespace sikku::pdf_x_test
