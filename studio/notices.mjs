// Third-party software in the page, with licences: npm packages from their folders, C++ libraries by name.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";

const mit = (name, what, copyright) => ({ name, what, licence: "MIT", text: `${copyright}

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated
documentation files (the "Software"), to deal in the Software without restriction, including without limitation the
rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
persons to whom the Software is furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the
Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE
WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.` });

const libraries = [
    {
        name: "Boost",
        what: "graphs, intervals, sorting",
        licence: "BSL-1.0",
        text:
            "Copyright Boost project contributors. Distributed under the Boost Software License, Version 1.0: " +
            "https://www.boost.org/LICENSE_1_0.txt",
    },
    mit("GLM", "vectors and rotations", "Copyright (c) 2005 - G-Truc Creation"),
    mit("fmt", "formatting", "Copyright (c) 2012 - present, Victor Zverovich"),
    mit("nlohmann/json", "JSON", "Copyright (c) 2013-2022 Niels Lohmann"),
    mit("fast_float", "reading numbers", "Copyright (c) 2021 The fast_float authors"),
    mit("toml++", "reading TOML", "Copyright (c) Mark Gillard <mark.gillard@outlook.com.au>"),
    mit("Emscripten", "the C++ libraries in the browser", "Copyright (c) 2010-2014 Emscripten authors"),
    mit("musl", "C library", "Copyright (c) 2005-2020 Rich Felker, et al."),
    {
        name: "libc++, libc++abi",
        what: "C++ library",
        licence: "Apache-2.0 WITH LLVM-exception",
        text:
            "Copyright (c) 2009-2019 by the contributors listed in CREDITS.TXT of LLVM. Licensed under the Apache " +
            "License, Version 2.0, with LLVM exceptions: https://llvm.org/LICENSE.txt",
    },
];

const read = (...path) => JSON.parse(readFileSync(join(...path, "package.json"), "utf8"));

// The packages that one depends on, with those that these depend on, and so forth.
function packagesOf({ dependencies = {} }, folder, found = new Set()) {
    for (const name of Object.keys(dependencies)) {
        if (!found.has(name)) packagesOf(read(folder, name), folder, found.add(name));
    }
    return found;
}

/// Returns a list of {name, version, licence, text}. @param names  npm packages; by default all that the page contains
export function notices(folder, names = [...packagesOf(read(folder, ".."), folder)]) {
    const packages = names.sort().map((name) => {
        const { version, license: licence } = read(folder, name);
        const file = readdirSync(join(folder, name)).find((each) => /^licen[cs]e/i.test(each));
        const text = file ? readFileSync(join(folder, name, file), "utf8").trim() : "";
        return { name, what: "", version, licence, text };
    });
    return [...libraries.map((each) => ({ version: "", ...each })), ...packages];
}
