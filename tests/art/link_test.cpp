// tests/art/link_test.cpp: works as links, and links with arbitrary bytes.
#include "art/link/link.h"

#include "tests/checks.h"
#include "tests/fuzz/link_targets.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <string>
#include <string_view>
#include <vector>

namespace sikku::link_test {

SharedWork rich_work() {
    SharedWork work;
    work.name = "curve.lsys";
    work.text = "title: Ñandú கோலம்\naxiom: X\nX --> -YF+XFX+FY-\n\tY --> \"\\+X</script>\r\n";
    work.variant = "b";
    work.settings = {{"derivation length", "4"}, {"seed", "18446744073709551615"}, {"angle", "80"}};
    work.draw = {
        {"size", "A3"}, {"spot", "Kaavi=#b3452c"}, {"spot", "White=white"}, {"dots", ""}, {"mirror", "true"}};
    work.play = {{"tempo", "90"}};
    work.page = {{"place", "{\"x\":\"1\"}"}, {"panel", "map"}};
    return work;
}

std::string message_of(std::string_view link) {
    return error_of<LinkError>([&] { read_link(link); });
}

/// The fragment that contains this JSON, valid or not.
std::string link_with(const std::string& json) {
    std::string packed(json.size() + 1000, '\0');
    z_stream stream{};
    deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(json.data()));
    stream.avail_in = static_cast<uInt>(json.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(packed.size() - stream.avail_out);
    deflateEnd(&stream);
    return "sikku1." + base64url(packed);
}

TEST(Link, WorksComeBack) {
    const SharedWork work = rich_work();
    const std::string link = link_of(work);
    EXPECT_TRUE(link.starts_with("sikku1."));
    EXPECT_EQ(link.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_", 7),
              std::string::npos);
    EXPECT_EQ(link_of(read_link(link)), link);
    EXPECT_EQ(shared_json(read_link(link)), shared_json(work));
    SharedWork plain;
    plain.name = "a.lsys";
    const SharedWork back = read_link(link_of(plain));
    EXPECT_EQ(back.name, "a.lsys");
    EXPECT_EQ(back.text, "");
    EXPECT_TRUE(back.settings.empty() && back.draw.empty() && back.play.empty() && back.page.empty());
}

/// Links of earlier versions must remain readable, and equal works must give equal links on every machine.
TEST(Link, BytesStayTheSame) {
    SharedWork work;
    work.name = "curve.lsys";
    work.text = "axiom: F\nF --> F+F\n";
    work.settings = {{"derivation length", "3"}};
    work.draw = {{"size", "A3"}};
    const std::string json =
        R"({"pattern":{"name":"curve.lsys","text":"axiom: F\nF --> F+F\n","settings":[["derivation length","3"]]},)"
        R"("draw":[["size","A3"]]})";
    EXPECT_EQ(link_of(work), link_with(json));
    EXPECT_EQ(link_of(work),
              "sikku1.HcqxDoJAEIThV7lMK9jYXWFicy-BFBvZ4CawmLsVEMK7u6GbfPPv-JAZZ0XcoTQyIl7fPPN1KL-"
              "CCsarudEq0xhDemoKdX0P6eLT78Jmon1BbBp0nGUmk0nDwNrb24Mb2vao0GVazqbIxs6P0_8");
}

TEST(Link, EveryForm) {
    const std::string link = link_of(rich_work());
    std::string encoded;  // as a careful program writes it
    for (const char letter : link) {
        encoded += letter == '-' ? "%2d" : letter == '_' ? "%5F" : letter == '.' ? "%2E" : std::string(1, letter);
    }
    for (const std::string& text : {link, '#' + link, "https://example.org/a/sikku-studio.html#" + link,
                                    "file:///home/a%20b/sikku-studio.html#" + link,
                                    "HTTP://localhost:8000/?x=1#" + link, '#' + encoded, " \n#" + link + "\r\n"}) {
        EXPECT_TRUE(is_link(text) || text.find('%') != std::string::npos) << text;
        EXPECT_EQ(link_of(read_link(text)), link) << text;
    }
    for (const char* text : {"snake-kolam", "my.lsys", "folder/my.lsys", "sikku1.lsys", "sikku.lsys", "sikku",
                             "sikku1", "-", "", "#", "http", "C#"}) {
        EXPECT_FALSE(is_link(text)) << text;
    }
    EXPECT_TRUE(is_link("sikku2.abc"));
    EXPECT_TRUE(is_link("https://example.org"));
}

TEST(Link, HostileInputIsRefused) {
    const std::string link = link_of(rich_work());
    EXPECT_EQ(message_of("https://example.org/"), "this address contains no pattern: expected a part after '#'");
    EXPECT_EQ(message_of("https://example.org/#top"), "this link contains no pattern: expected '#sikku1.…'");
    EXPECT_EQ(message_of(""), "this link contains no pattern: expected '#sikku1.…'");
    EXPECT_EQ(message_of("sikku2." + link.substr(7)), "this link was made by a newer version of Sikku");
    EXPECT_EQ(message_of("sikku1."), "the link is damaged or incomplete");
    EXPECT_EQ(message_of(link + "%4"), "the link is damaged: '%' without two hexadecimal digits");
    EXPECT_EQ(message_of(link + "%zz"), "the link is damaged: '%' without two hexadecimal digits");
    EXPECT_EQ(message_of(link + "="), "the link is damaged: it contains an invalid character");
    EXPECT_EQ(message_of(link + "%00"), "the link is damaged: it contains an invalid character");
    for (std::size_t length = 7; length < link.size(); ++length) {
        EXPECT_NE(message_of(link.substr(0, length)), "") << length;
    }
    EXPECT_NE(message_of(link + "AAAA"), "") << "nothing may follow";
}

TEST(Link, ContentsAreChecked) {
    const std::string pattern = R"("pattern":{"name":"a","text":"b"})";
    EXPECT_EQ(message_of(link_with("{" + pattern + "}")), "");
    for (const std::string& json :
         std::vector<std::string>{"",
                                  "[]",
                                  "null",
                                  "{",
                                  "{}",
                                  R"({"pattern":[]})",
                                  R"({"pattern":{"name":"a"}})",
                                  R"({"pattern":{"name":1,"text":"b"}})",
                                  R"({"pattern":{"name":"a","text":null}})",
                                  R"({"pattern":{"name":"","text":"b"}})",
                                  R"({"pattern":{"name":"/etc/passwd","text":"b"}})",
                                  R"({"pattern":{"name":"..","text":"b"}})",
                                  R"({"pattern":{"name":"a\u001b[2J","text":"b"}})",
                                  R"({"pattern":{"name":")" + std::string(256, 'a') + R"(","text":"b"}})",
                                  R"({"pattern":{"name":"a","text":"b","more":1}})",
                                  "{" + pattern + R"(,"more":1})",
                                  "{" + pattern + R"(,"draw":{"size":"A3"}})",
                                  "{" + pattern + R"(,"draw":[["size"]]})",
                                  "{" + pattern + R"(,"draw":[["size",3]]})",
                                  "{" + pattern + R"(,"draw":[["a","b","c"]]})",
                                  "{" + pattern + R"(,"page":[]})",
                                  "{" + pattern + R"(,"page":{"a":1}})",
                                  "{" + pattern + "," + pattern + "}",
                                  "{" + pattern + "}{}",
                                  "{" + pattern + R"(,"play":[[1e999,"b"]]})",
                                  "{\"pattern\":{\"name\":\"a\",\"text\":\"\xff\"}}",
                                  "{" + pattern + R"(,"draw":)" + std::string(100'000, '[')}) {
        const std::string message = message_of(link_with(json));
        EXPECT_TRUE(message.starts_with("the link is damaged: ")) << json.substr(0, 100) << ": " << message;
    }
    std::string pairs;
    for (int i = 0; i < 1001; ++i) pairs += std::string(i > 0 ? "," : "") + R"(["a","b"])";
    EXPECT_TRUE(message_of(link_with("{" + pattern + R"(,"draw":[)" + pairs + "]}")).find("at most 1000 pairs") !=
                std::string::npos);
}

TEST(Link, SizesAreLimited) {
    // 70 MB of blanks become 70 kB.
    EXPECT_EQ(message_of(link_with(std::string(std::size_t{70} << 20, ' '))), "the link contains more than 64 MB");
    EXPECT_EQ(message_of(std::string(most_link_bytes + 1, 'A')), "the link is too long: at most 64 MB");
    SharedWork work = rich_work();
    work.text = std::string(most_link_bytes, ' ');
    EXPECT_THROW(link_of(work), LinkError);
    work = rich_work();
    work.text = "\xff";
    EXPECT_THROW(link_of(work), LinkError);
    work = rich_work();
    work.name = "a/b.lsys";
    EXPECT_THROW(link_of(work), LinkError);
    work = rich_work();
    work.draw.resize(1001, {"a", "b"});
    EXPECT_THROW(link_of(work), LinkError);
}

TEST(Link, ChangedLinksAreReadOrRefused) {
    const std::string link = link_of(rich_work());
    for (std::size_t at = 0; at < link.size(); ++at) {
        for (const char byte : {'\0', '%', '#', 'A', '_', '\xFF', static_cast<char>(link[at] + 1)}) {
            std::string changed = link;
            changed[at] = byte;
            EXPECT_NO_THROW(try_link(changed)) << at;
        }
    }
}

}  // namespace sikku::link_test
