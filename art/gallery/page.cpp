#include "art/gallery/page.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <embedded/gallery_page.h>
#include <fmt/format.h>

#include <map>

namespace sikku {
namespace {

/// A string of JSON within a script of HTML.
std::string script_string(std::string_view text) {
    std::string clean;
    clean.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        clean += length == 0 ? std::string_view("\xEF\xBF\xBD") : text.substr(i, length);
        i += length == 0 ? 1 : length;
    }
    std::string result;
    for (const char byte : json_string(clean)) {
        if (byte == '<') {  // </script> and <!-- have a meaning in HTML
            result += "\\u003c";
        } else {
            result += byte;
        }
    }
    return result;
}

/// A member of the page's record of an entry; those that are empty are left out.
void put(std::string& out, std::string_view key, std::string_view value) {
    if (!value.empty()) fmt::format_to(std::back_inserter(out), ",\"{}\":{}", key, script_string(value));
}

std::string record(const GalleryEntry& entry, std::size_t pattern) {
    std::string out = "{\"name\":" + script_string(entry.name);
    put(out, "title", entry.title);
    put(out, "source", entry.source);
    put(out, "description", entry.description);
    put(out, "kind", entry.kind);
    put(out, "n", entry.n);
    put(out, "angle", entry.angle);
    put(out, "growth", entry.growth);
    put(out, "settings", entry.settings);
    put(out, "print", entry.print);
    if (entry.thumbnail != entry.print) put(out, "thumbnail", entry.thumbnail);
    out += fmt::format(",\"pattern\":{}", pattern);
    if (entry.width > 0 && entry.height > 0) out += fmt::format(",\"size\":[{},{}]", entry.width, entry.height);
    if (!entry.extras.empty()) {
        out += ",\"extras\":[";
        for (const auto& [label, path] : entry.extras) {
            out += fmt::format("[{},{}],", script_string(label), script_string(path));
        }
        out.back() = ']';
    }
    return out + '}';
}

}  // namespace

void write_gallery_page(std::string_view title, std::span<const GalleryEntry> entries, Output& out) {
    const std::string heading = xml_escaped(title.empty() ? "Gallery" : title);
    std::string head = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
        "style-src 'unsafe-inline'; img-src 'self' file: data:; base-uri 'none'; form-action 'none'\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<meta name=\"generator\" content=\"Sikku\"/>\n<link rel=\"icon\" href=\"data:,\"/>\n"
        "<title>{}</title>\n<style>\n",
        heading);
    // Rice-flour white on red earth. The band under the title is the simplest kolam: two lines around a row of dots.
    head += page_css;
    head += fmt::format("</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n</header>\n", heading);
    head += page_html;
    head += "<script type=\"application/json\" id=\"gallery\">{\"patterns\":[";
    out.write(head);

    std::map<std::string_view, std::size_t> numbers;
    std::vector<std::size_t> patterns;
    for (const GalleryEntry& entry : entries) {
        const auto [known, is_new] = numbers.emplace(entry.pattern, numbers.size());
        patterns.push_back(known->second);
        if (is_new) out.write((numbers.size() == 1 ? "\n" : ",\n") + script_string(entry.pattern));
    }
    out.write("],\n\"entries\":[");
    for (std::size_t i = 0; i < entries.size(); ++i) {
        out.write((i == 0 ? "\n" : ",\n") + record(entries[i], patterns[i]));
    }
    out.write("]}</script>\n<script>\n");
    out.write(page_js);
    out.write("</script>\n</body>\n</html>\n");
}

}  // namespace sikku
