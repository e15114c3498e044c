#include "music/score/engraving.h"

#include "engine/base/diagnostic.h"
#include "engine/base/input_file.h"
#include "engine/base/output_file.h"
#include "music/score/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace sikku {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed with this object.
class WorkFolder {
public:
    WorkFolder() : name_((temporary_folder() / "sikku-score.XXXXXX").string()) {
        if (::mkdtemp(name_.data()) == nullptr) child::fail(name_, "write the folder", errno);
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    ~WorkFolder() {
        std::error_code ignored;
        fs::remove_all(name_, ignored);
    }
    fs::path operator/(const char* file) const { return fs::path(name_) / file; }

private:
    std::string name_;
};

/// A text of PDF: UTF-16 in hexadecimal digits.
std::string text_string(std::string_view text) {
    std::string digits = "<FEFF";
    const auto put = [&](std::uint32_t unit) { fmt::format_to(std::back_inserter(digits), "{:04X}", unit); };
    while (!text.empty()) {
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]) & 0x3FU; };
        const std::size_t length = std::max<std::size_t>(1, utf8_length(text));
        std::uint32_t code = static_cast<unsigned char>(text[0]);
        if (length == 1 && code >= 0x80) code = 0xFFFD;
        if (length == 2) code = (code & 0x1F) << 6 | byte(1);
        if (length == 3) code = (code & 0x0F) << 12 | byte(1) << 6 | byte(2);
        if (length == 4) code = (code & 0x07) << 18 | byte(1) << 12 | byte(2) << 6 | byte(3);
        if (code < 0x10000) {
            put(code);
        } else {
            put(0xD800 + ((code - 0x10000) >> 10));
            put(0xDC00 + ((code - 0x10000) & 0x3FF));
        }
        text.remove_prefix(length);
    }
    return digits + ">";
}

std::uint64_t number_at(std::string_view text, std::size_t at) {
    std::uint64_t number = 0;
    if (at < text.size()) std::from_chars(text.data() + at, text.data() + text.size(), number);
    return number;
}

/// Replaces the information of a PDF, its table of objects and its random identifier. A file with another layout than
/// Ghostscript's is not changed.
std::string with_texts(std::string pdf, const ScoreHead& head) {
    constexpr std::string_view start_mark = "startxref\n";
    constexpr std::string_view table_mark = "xref\n0 ";
    constexpr std::string_view root_mark = "/Root ";
    constexpr std::size_t entry_bytes = 20;
    const std::size_t start = pdf.rfind(start_mark);
    if (start == std::string::npos) return pdf;
    const std::size_t table = number_at(pdf, start + start_mark.size());
    if (table >= start || pdf.compare(table, table_mark.size(), table_mark) != 0) return pdf;
    const std::uint64_t objects = number_at(pdf, table + table_mark.size());
    const std::size_t first = pdf.find('\n', table + table_mark.size()) + 1;
    const std::size_t root = pdf.find(root_mark, first);
    if (objects > (start - first) / entry_bytes || root == std::string::npos) return pdf;
    const std::string entries = pdf.substr(first, objects * entry_bytes);
    const std::uint64_t catalog = number_at(pdf, root + root_mark.size());
    pdf.resize(table);
    const auto out = std::back_inserter(pdf);
    fmt::format_to(out, "{} 0 obj\n<< /Title {}\n/Subject {}\n/SikkuPattern {}\n/Creator (Sikku) >>\nendobj\n",
                   objects, text_string(head.title), text_string(head.made), text_string(head.pattern));
    const std::size_t new_table = pdf.size();
    fmt::format_to(out, "xref\n0 {}\n{}{:010} 00000 n \n", objects + 1, entries, table);
    fmt::format_to(out, "trailer\n<< /Size {} /Root {} 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n", objects + 1,
                   catalog, objects, new_table);
    return pdf;
}

}  // namespace

void engrave(std::string_view lilypond, const ScoreHead& head, const fs::path& output, const fs::path& shown,
             const std::function<void()>& watch) {
    const auto program = child::find_program("lilypond");
    if (!program) child::fail_without("a printed score as PDF", "lilypond", ": apt install lilypond");
    const WorkFolder folder;
    const fs::path score = folder / "score.ly";
    {
        const Descriptor file(::open(score.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
        if (file.get() < 0) child::fail(score, "write", errno);
        child::write_all(file.get(), lilypond.data(), lilypond.size(), score);
    }
    const Descriptor messages = lifted(child::nameless_file(score));
    Process process({.program = *program,
                     .arguments = {"--loglevel=WARNING", "-dno-point-and-click", "--pdf",
                                   "--output=" + (folder / "score").string(), score.string()},
                     .descriptors = {-1, messages.get(), messages.get(), -1},
                     .environment = {"SOURCE_DATE_EPOCH=0"}});
    std::optional<int> status;
    constexpr auto pause = std::chrono::milliseconds(50);
    while (!(status = process.ended())) {
        if (watch) watch();
        std::this_thread::sleep_for(pause);
    }
    const fs::path print = folder / "score.pdf";
    if (!WIFEXITED(*status) || WEXITSTATUS(*status) != 0 || !child::is_readable_file(print)) {
        const std::string words = child::last_words(messages.get(), "lilypond");
        const std::string reason = WIFSIGNALED(*status) ? fmt::format("signal {} ended it", WTERMSIG(*status))
                                   : WEXITSTATUS(*status) != 0
                                       ? fmt::format("it ended with status {}", WEXITSTATUS(*status))
                                       : "it wrote no PDF";
        throw std::runtime_error(
            fmt::format("lilypond failed: {}{}{}", reason, words.empty() ? "" : "; its last messages:\n", words));
    }
    constexpr std::size_t most_bytes = std::size_t{1} << 30;
    const std::string whole = with_texts(read_file(print, "the print of lilypond", most_bytes), head);
    const Descriptor file(::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.get() < 0) child::fail(shown, "write", errno);
    child::write_all(file.get(), whole.data(), whole.size(), shown);
}

}  // namespace sikku
