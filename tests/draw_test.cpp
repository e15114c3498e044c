#include "art/draw.h"

#include "tests/print_tools.h"

#include <pugixml.hpp>

namespace sikku {
namespace {

/// The drawing of a pattern on a page of 100 x 60 mm with margins of 5 mm.
class Draw : public ::testing::Test {
protected:
    DrawReport draw(const std::string& text, const std::string& name = "print.svg") {
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
        const Grammar grammar = compile_grammar(pattern, diagnostics);
        Print print;
        print.page = {100.0, 60.0, 5.0};
        print.dpi = 25.4;
        print.style = read_style(pattern, 300.0, diagnostics);
        print.pattern = text;
        diagnostics.throw_if_errors();
        options_.format = print_format(name).value();
        return sikku::draw(grammar, print, options_, folder_ / name);
    }

    /// Attributes of what the print holds, found by an XPath.
    std::vector<std::string> found(const std::string& path, const char* attribute) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_file((folder_ / "print.svg").c_str()));
        std::vector<std::string> list;
        for (const auto& node : document.select_nodes(path.c_str())) {
            list.emplace_back(node.node().attribute(attribute).value());
        }
        return list;
    }

    ScratchFolder folder_;
    DrawOptions options_;
};

TEST_F(Draw, AWidthThatIsSetIsInTheUnitOfTheStroke) {
    options_.placement.step = 10.0;
    const DrawReport points = draw("axiom: !(2)F\nstroke: 1pt\n");
    EXPECT_EQ(found("//g[path]", "stroke-width"), std::vector<std::string>{"705.556"});
    EXPECT_NEAR(points.size.x, 2 * 25.4 / 72, 1e-9);
    EXPECT_NEAR(points.size.y, 10 + 2 * 25.4 / 72, 1e-9);
    const DrawReport steps = draw("axiom: !(0.5)F\nstroke: 0.1 step\n");
    EXPECT_EQ(found("//g[path]", "stroke-width"), std::vector<std::string>{"5000"});
    EXPECT_NEAR(steps.size.x, 5, 1e-9);
}

}  // namespace
}  // namespace sikku
