#include "art/vector/pdf.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>

namespace sikku::pdf_provenance_test {

/// A print from `pattern`.
void write(const std::filesystem::path& path, const std::string& pattern, const std::string& made,
           const std::string& title = "A test") {
    Print print = plain_print();
    print.pattern = pattern;
    print.made = made;
    print.title = title;
    write_print(path, print, write_pdf, draw_sampler);
}

TEST(PdfProvenance, EveryTextComesBackByteForByte) {
    const ScratchFolder folder;
    const auto path = folder / "print.pdf";
    const std::string all_at_once =
        "title: கோலம் \xF0\x9F\x8C\xBC (a) \\ )(\r\naxiom: F(1)\\F \\\r\n\tF\r\n// \xEF\xBF\xBD \xC2\xA0 ü\x01\x7F\n";
    for (const std::string& text :
         {std::string("axiom: F\n"), std::string("axiom: F"), std::string("axiom: F(1)\\F((\\) \\\\\n"),
          std::string("axiom: F \\\nF\n\n"), std::string("axiom: F\r\nF --> FF\r\n"),
          std::string("\xEF\xBB\xBF"
                      "axiom: F\n"),
          std::string("title: /SikkuPattern (axiom: G) >>\nendobj\naxiom: F\n"),
          std::string("title: ü /SikkuPattern (axiom: G) >>\nstartxref\n0\n"), all_at_once,
          std::string(300'000, '\\') + std::string(300'000, '(')}) {
        for (const std::string title : {"", "A (test) \\", "கோலம்", "/SikkuPattern (axiom: H) >>"}) {
            write(path, text, "sikku 0.1.0, -n 4 --set 'title=(ü)'", title);
            const auto provenance = provenance_of(path);
            ASSERT_TRUE(provenance) << text.substr(0, 100);
            EXPECT_EQ(provenance->pattern, text);
            EXPECT_EQ(provenance->made, "sikku 0.1.0, -n 4 --set 'title=(ü)'");
        }
    }
    write(path, "axiom: F\n", "");
    EXPECT_EQ(provenance_of(path)->made, "");
}

TEST(PdfProvenance, WhatOthersRewriteIsReadRightOrNotAtAll) {
    if (!has_program("qpdf")) GTEST_SKIP() << "no qpdf on this machine";
    const ScratchFolder folder;
    for (const std::string text :
         {"axiom: F\tF\\\n(F) \\ \n", "axiom: (((F)\n", "title: ü\r\naxiom: F\n", "title: \x01\x02\naxiom: F\n"}) {
        write(folder / "print.pdf", text, "sikku");
        for (const std::string options : {"", "--qdf", "--linearize", "--object-streams=generate"}) {
            ASSERT_TRUE(
                run_tool("qpdf " + options + " '" + folder.file("print.pdf") + "' '" + folder.file("other.pdf") + "'")
                    .ok);
            const auto provenance = provenance_of(folder / "other.pdf");
            if (provenance) {
                EXPECT_EQ(provenance->pattern, text) << options;
            }
        }
    }
}

TEST(PdfProvenance, OtherFilesHoldNoPattern) {
    const ScratchFolder folder;
    const auto path = folder / "print.pdf";
    write(path, "", "sikku");
    EXPECT_FALSE(provenance_of(path)) << "a print without a pattern";
    EXPECT_FALSE(provenance_of(folder / "missing.pdf"));
    EXPECT_FALSE(provenance_of(folder.path()));
    EXPECT_FALSE(provenance_of("/dev/null"));
    write(path, "axiom: (\\) ü F\n", "sikku");
    const std::string whole = contents(path);
    const auto write_bytes = [&](const std::string& bytes) {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    };
    write_bytes("");
    EXPECT_FALSE(provenance_of(path));
    // Cut off anywhere, or with any one byte of its end changed, it is read or refused, and never beyond its end.
    for (std::size_t length = whole.size() - 1; length > whole.size() - 1200; length -= 7) {
        write_bytes(whole.substr(0, length));
        const auto provenance = provenance_of(path);
        if (provenance) {
            EXPECT_EQ(provenance->pattern, "axiom: (\\) ü F\n");
        }
    }
    for (std::size_t at = whole.size() - 1200; at < whole.size(); at += 11) {
        for (const char byte : {'\0', '9', '(', '<', '>', '\xFF'}) {
            std::string bytes = whole;
            bytes[at] = byte;
            write_bytes(bytes);
            provenance_of(path);
        }
    }
    for (const char* end : {"startxref\n0\n%%EOF\n", "startxref\n99999999999999999999\n", "startxref\n-1\n",
                            "xref\n0 1\ntrailer\n<< /Info 18446744073709551615 0 R >>\nstartxref\n0\n%%EOF\n",
                            "xref\n0 1\ntrailer\n<< /Info 1 0 R >>\nstartxref\n0\n%%EOF\n", "startxref\n"}) {
        write_bytes(end);
        EXPECT_FALSE(provenance_of(path)) << end;
    }
}

}  // namespace sikku::pdf_provenance_test
