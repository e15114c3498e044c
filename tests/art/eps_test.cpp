// EPS: structure, and the same picture as the PDF in an interpreter of PostScript.
#include "art/prints.h"
#include "engine/language/document.h"
#include "tests/files.h"
#include "tests/tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace sikku::eps_test {

constexpr const char* flower =
    "title: A (flower\nangle factor: 6\nderivation length: 2\naxiom: {X}[;{X}]@O(2)\nX --> "
    "F-F++F-F\nF --> F-F++F-F\n"
    "palette: navy #c03040 #30a050\nground: #f0e8d0\nfill: #80c0e0\nstroke: 0.4mm\n";

class Eps : public ::testing::Test {
protected:
    std::string file(const char* format, const Document& document, OptionValues values) const {
        values.push_back({"size", "60x80mm"});
        return folder_.write(std::string("print.") + format, draw(document, format, values));
    }
    /// The pixels of a page, at 100 dpi without smoothing.
    std::string pixels(const std::string& file) const {
        const std::string picture = (folder_.path() / "page.ppm").string();
        EXPECT_EQ(
            run_tool("gs -q -dNOPAUSE -dBATCH -dSAFER -dEPSCrop -sDEVICE=ppmraw -r100 -o " + picture + " " + file)
                .text,
            "");
        return contents(picture);
    }
    void expect_same(const Document& document, const OptionValues& values) const {
        const std::string eps = pixels(file("eps", document, values)), pdf = pixels(file("pdf", document, values));
        ASSERT_EQ(eps.size(), pdf.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < eps.size(); ++i) {
            const int gap = static_cast<unsigned char>(eps[i]) - static_cast<unsigned char>(pdf[i]);
            different += std::abs(gap) > 8;
        }
        EXPECT_LT(different, eps.size() / 100);
    }
    ScratchFolder folder_;
};

TEST_F(Eps, ShowsThePictureOfThePdf) {
    NEEDS("gs");
    const Document document = parse("flower.lsys", flower);
    expect_same(document, {});
    expect_same(document, {{"border", "kaavi"}});
    expect_same(document, {{"window", "-1,-1,4,4"}});
    expect_same(document, {{"plotter", "true"}, {"hatch", "2mm"}});
    expect_same(document, {{"generations", "0:2"}});
    expect_same(parse("spline.lsys", std::string(flower) + "line: spline\n"), {});
    expect_same(parse("hand.lsys", std::string(flower) + "hand: 0.5\n"), {});
}

TEST_F(Eps, HasTheBoxOfThePage) {
    NEEDS("gs");
    const Document document = parse("flower.lsys", flower);
    const std::string eps = contents(file("eps", document, {}));
    EXPECT_EQ(
        eps.rfind("%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 171 227\n%%HiResBoundingBox: 0 0 170.0787 226.7717\n"
                  "%%Title: A (flower\n",
                  0),
        0U);
    EXPECT_EQ(eps.substr(eps.size() - 6), "%%EOF\n");
    std::istringstream lines(eps);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 255U);
    for (const char byte : eps) ASSERT_TRUE(byte == '\n' || (byte >= 0x20 && byte < 0x7F));
    // The ground covers the page.
    const std::string box =
        run_tool("gs -q -dNOPAUSE -dBATCH -sDEVICE=bbox " + (folder_.path() / "print.eps").string()).text;
    EXPECT_TRUE(has(box, "%%BoundingBox: 0 0 171 227\n"));
    EXPECT_EQ(eps, contents(file("eps", document, {})));
}

TEST_F(Eps, MixesTranslucentColours) {
    const Document document = parse("square.lsys",
                                    "angle factor: 4\nderivation length: 0\naxiom: {F+F+F+F}\nstroke: none\n"
                                    "ground: white\nfill: #ff000080\n");
    const MadeWork made = made_work(prints(), document, "eps");
    // Half of red and half of white.
    EXPECT_TRUE(has(made.bytes(), "\n1 0.498 0.498 k\n"));
    EXPECT_TRUE(has(made.remarks, "warning: an EPS has no opacity"));
}

TEST_F(Eps, RefusesPages) {
    const Document document = parse("flower.lsys", flower);
    EXPECT_THROW(draw(document, "eps", {{"lesson", ""}}), SettingError);
    EXPECT_THROW(draw(document, "eps", {{"marks", "true"}}), SettingError);
    EXPECT_THROW(draw(document, "eps", {{"animate", "3"}}), SettingError);
    EXPECT_THROW(draw(document, "eps", {{"plotter", "true"}, {"profile", "axidraw"}}), SettingError);
}

}  // namespace sikku::eps_test
