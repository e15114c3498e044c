#include "art/gallery/page.h"
#include "tests/checks.h"
#include "tests/pages.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdint>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::gallery_page_test {

class Memory : public MemoryOutput {
public:
    void overwrite(std::uint64_t, std::string_view) override { throw std::logic_error("a page is written forwards"); }
    const std::string& text = bytes_;
};

std::string page(const std::vector<GalleryEntry>& entries, std::string_view title = "Kolams") {
    Memory memory;
    write_gallery_page(title, entries, memory);
    return memory.text;
}

GalleryEntry entry(const std::string& name) {
    GalleryEntry result;
    result.name = name;
    result.title = "Title of " + name;
    result.kind = "kolams";
    result.n = "4";
    result.angle = "90";
    result.growth = "exponential";
    result.pattern = "title: Title of " + name + "\naxiom: X\n";
    result.print = "prints/" + name + ".svg";
    result.thumbnail = "thumbnails/" + name + ".png";
    result.width = 210;
    result.height = 297;
    return result;
}
std::vector<GalleryEntry> some() {
    std::vector<GalleryEntry> entries = {entry("snake"), entry("anklets"), entry("mango")};
    entries[1].extras = {{"MIDI", "anklets.mid"}, {"Score", "anklets.musicxml"}};
    entries[2].thumbnail = entries[2].print;
    return entries;
}

/// What the page's script is given.
std::string data(const std::string& text) {
    const std::string_view begin = "id=\"gallery\">";
    const std::size_t at = text.find(begin) + begin.size();
    return text.substr(at, text.find("</script>", at) - at);
}

constexpr std::string_view evil =
    "<b>&amp; \"A\" \\ 'B' </script><script>alert(1)</script> <!-- --> ]]> </title> \xF0\x9F\x8E\xB5 "
    "\xE2\x80\xA8\xE2\x80\xA9\x01\xFF\xE2\x80\n";

TEST(GalleryPage, HoldsEveryPrint) {
    EXPECT_EQ(data(page(some())),
              "{\"patterns\":[\n"
              "\"title: Title of snake\\u000aaxiom: X\\u000a\",\n"
              "\"title: Title of anklets\\u000aaxiom: X\\u000a\",\n"
              "\"title: Title of mango\\u000aaxiom: X\\u000a\"],\n"
              "\"entries\":[\n"
              "{\"name\":\"snake\",\"title\":\"Title of snake\",\"kind\":\"kolams\",\"n\":\"4\",\"angle\":\"90\","
              "\"growth\":\"exponential\",\"print\":\"prints/snake.svg\",\"thumbnail\":\"thumbnails/snake.png\","
              "\"pattern\":0,\"size\":[210,297]},\n"
              "{\"name\":\"anklets\",\"title\":\"Title of anklets\",\"kind\":\"kolams\",\"n\":\"4\",\"angle\":\"90\","
              "\"growth\":\"exponential\",\"print\":\"prints/anklets.svg\",\"thumbnail\":\"thumbnails/anklets.png\","
              "\"pattern\":1,\"size\":[210,297],"
              "\"extras\":[[\"MIDI\",\"anklets.mid\"],[\"Score\",\"anklets.musicxml\"]]},\n"
              "{\"name\":\"mango\",\"title\":\"Title of mango\",\"kind\":\"kolams\",\"n\":\"4\",\"angle\":\"90\","
              "\"growth\":\"exponential\",\"print\":\"prints/mango.svg\",\"pattern\":2,\"size\":[210,297]}]}");
    // Of an entry that is all but empty nothing is made up.
    GalleryEntry bare;
    bare.name = "x";
    bare.print = "x.pdf";
    bare.width = 100;
    EXPECT_EQ(data(page({bare})),
              "{\"patterns\":[\n\"\"],\n\"entries\":[\n{\"name\":\"x\",\"print\":\"x.pdf\",\"pattern\":0}]}");
    EXPECT_EQ(data(page({})), "{\"patterns\":[],\n\"entries\":[]}");
}

TEST(GalleryPage, HoldsATextThatManyShareOnce) {
    std::vector<GalleryEntry> sweep;
    for (int i = 0; i < 5000; ++i) {
        sweep.push_back(entry("snake"));
        sweep.back().name += "-" + std::to_string(i);
        if (i % 2 == 1) sweep.back().pattern = "axiom: Y\n";
    }
    const std::string text = page(sweep);
    EXPECT_EQ(count_of(text, "axiom: "), 2U);
    EXPECT_EQ(count_of(text, "\"pattern\":0,"), 2500U);
    EXPECT_EQ(count_of(text, "\"pattern\":1,"), 2500U);
    for (const GalleryEntry& each : sweep) {
        EXPECT_TRUE(has(text, "{\"name\":\"" + each.name + "\",")) << each.name;
    }
    EXPECT_LT(text.size(), 5000U * 256U);
}

TEST(GalleryPage, IsWellFormedAndNamesWhatItHas) {
    const std::string text = page(some(), "Kolams & tilings");
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_string(markup(text).c_str(), pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata);
    ASSERT_TRUE(result) << result.description() << " at " << result.offset;
    const pugi::xml_node html = document.child("html");
    EXPECT_STREQ(html.attribute("lang").value(), "en");
    EXPECT_STREQ(html.child("head").child("title").child_value(), "Kolams & tilings");
    EXPECT_STREQ(html.child("body").child("header").child("h1").child_value(), "Kolams & tilings");
    // Every control has a name: a label around it, a text within it, or an attribute.
    const auto inputs = html.select_nodes("//input | //select");
    EXPECT_EQ(inputs.size(), 4U);
    for (const auto& input : inputs) EXPECT_STREQ(input.node().parent().name(), "label");
    for (const auto& button : html.select_nodes("//button")) {
        const bool named_later = std::string_view(button.node().attribute("id").value()) == "zoom-fit";
        EXPECT_TRUE(button.node().attribute("aria-label") || *button.node().child_value() || named_later);
        EXPECT_STREQ(button.node().attribute("type").value(), "button");
    }
    const std::set<std::string> ids = expect_ids(html, text);
    // Neither the script nor what tells one element of another asks for an id that is not there.
    for (const auto& element : html.select_nodes("//*[@aria-labelledby or @aria-describedby]")) {
        for (const char* name : {"aria-labelledby", "aria-describedby"}) {
            const pugi::xml_attribute attribute = element.node().attribute(name);
            EXPECT_TRUE(!attribute || ids.contains(attribute.value())) << attribute.value();
        }
    }
}

TEST(GalleryPage, AsksForNothingElse) {
    const std::string text = page(some());
    EXPECT_TRUE(has(text, "content=\"default-src 'none'; "));
    // Namespaces of pictures in the style are no addresses.
    EXPECT_EQ(count_of(text, "http"),
              count_of(text, "xmlns='http://www.w3.org/2000/svg'") + count_of(text, "http-equiv="));
    for (const char* part : {"<script src", "@import", "fetch(", "XMLHttpRequest", "eval(", "innerHTML"}) {
        EXPECT_FALSE(has(text, part)) << part;
    }
}

TEST(GalleryPage, TextsAreTexts) {
    GalleryEntry hostile;
    for (std::string* text :
         {&hostile.name, &hostile.title, &hostile.source, &hostile.description, &hostile.kind, &hostile.n,
          &hostile.angle, &hostile.growth, &hostile.settings, &hostile.pattern, &hostile.print, &hostile.thumbnail}) {
        *text = evil;
    }
    hostile.thumbnail += ".png";
    hostile.extras = {{std::string(evil), std::string(evil)}};
    const std::string text = page({hostile}, evil);
    EXPECT_EQ(count_of(text, "<script"), 2U);
    EXPECT_EQ(count_of(text, "</script"), 2U);
    EXPECT_EQ(count_of(text, "<title"), 1U);
    EXPECT_EQ(count_of(text, "</title"), 1U);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(markup(text).c_str(), pugi::parse_default | pugi::parse_ws_pcdata));
    const pugi::xml_node html = document.child("html");
    const std::string in_html =
        "<b>&amp; \"A\" \\ 'B' </script><script>alert(1)</script> <!-- --> ]]> </title> \xF0\x9F\x8E\xB5 "
        "\xE2\x80\xA8\xE2\x80\xA9\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\n";
    EXPECT_EQ(html.child("head").child("title").child_value(), in_html);
    EXPECT_EQ(html.child("body").child("header").child("h1").child_value(), in_html);
    const std::string in_script =
        "\\u003cb>&amp; \\\"A\\\" \\\\ 'B' \\u003c/script>\\u003cscript>alert(1)\\u003c/script> \\u003c!-- --> ]]> "
        "\\u003c/title> \xF0\x9F\x8E\xB5 \\u2028\\u2029\\u0001\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\\u000a";
    EXPECT_EQ(count_of(text, "\"" + in_script + "\""), 13U);
    EXPECT_EQ(count_of(text, "\"" + in_script + ".png\""), 1U);
    EXPECT_FALSE(has(data(text), "<"));
    // A page without a title has one all the same.
    EXPECT_TRUE(has(page({}, ""), "<title>Gallery</title>"));
}

TEST(GalleryPage, IsTheSameWhateverTheLocale) {
    const std::string first = page(some());
    for (const char* locale : {"C", "de_DE.UTF-8"}) {
        std::setlocale(LC_ALL, locale);
        EXPECT_TRUE(page(some()) == first);
    }
    std::setlocale(LC_ALL, "C");
}

TEST(GalleryPage, ThrowsWhatItsFileThrows) {
    class Full : public MemoryOutput {
        void write(std::string_view) override { throw std::runtime_error("the disk is full"); }
    };
    Full full;
    EXPECT_THROW(write_gallery_page("Kolams", some(), full), std::runtime_error);
}

}  // namespace sikku::gallery_page_test
