// tests/pages.h: reads pages of HTML.
#pragma once

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <set>
#include <string>

namespace sikku {

/// The page with what is in its scripts and its style left out.
inline std::string markup(std::string text) {
    for (const std::string name : {"script", "style"}) {
        for (std::size_t at = text.find("<" + name); at != std::string::npos; at = text.find("<" + name, at + 1)) {
            const std::size_t begin = text.find('>', at) + 1;
            text.erase(begin, text.find("</" + name + ">", begin) - begin);
        }
    }
    return text;
}

/// Returns the ids of the page, of which none may occur twice; its script may ask for no other.
inline std::set<std::string> expect_ids(const pugi::xml_node& html, const std::string& text) {
    std::set<std::string> ids;
    const auto with_id = html.select_nodes("//*[@id]");
    for (const auto& element : with_id) ids.insert(element.node().attribute("id").value());
    EXPECT_EQ(ids.size(), with_id.size());
    for (std::size_t at = text.find("element(\""); at != std::string::npos; at = text.find("element(\"", at + 1)) {
        const std::size_t begin = at + 9;
        EXPECT_TRUE(ids.contains(text.substr(begin, text.find('"', begin) - begin))) << text.substr(at, 40);
    }
    return ids;
}

}  // namespace sikku
