// Plays and draws in the built page, in headless Chromium: the highlighted production, loop, tempo, edits while
// playing, MIDI, the kolam bench by pointer and keys.
//     node tests/play_and_bench.mjs [PAGE]
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { addressOf, launch, patternText } from "./browser.mjs";

const browser = await launch();
const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
const page = await context.newPage();
const errors = [];
page.on("pageerror", (error) => errors.push(error.message));

// A MIDI output that records its messages, and the marks of highlighted notes.
await page.addInitScript(() => {
    localStorage.setItem("sikku-studio-explained", "true"); // the text has all its room
    window.midi = [];
    const port = {
        id: "1",
        name: "Test",
        state: "connected",
        send: (bytes, time) => window.midi.push({ bytes: [...bytes], time: time ?? performance.now() }),
        clear() {},
    };
    navigator.requestMIDIAccess = async () => ({ outputs: new Map([["1", port]]), onstatechange: null });
    window.lit = [];
    new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) if (entry.name === "note lit") window.lit.push(entry.detail);
    }).observe({ type: "mark" });
    window.frames_taken = [];
    let last = 0;
    const frame = (time) => {
        window.frames_taken.push(time - last);
        last = time;
        requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
});

const text = (selector) => page.locator(selector).first().textContent();
const until = (what, argument) => page.waitForFunction(what, argument, { timeout: 15000 });

async function write(pattern) {
    await page.evaluate((value) => {
        const data = new DataTransfer();
        data.setData("text/plain", value);
        const editor = document.querySelector(".cm-content");
        editor.focus();
        document.getSelection().selectAllChildren(editor);
        editor.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
    }, pattern);
}

async function play() {
    await page.click("#tab-play");
    await page.click(".cm-content");
    await page.keyboard.press("Control+a");
    await write(patternText("melodies/hilbert-in-c"));
    await until(() => /103 notes in 16 bars/.test(document.querySelector(".play-facts").textContent));
    await page.locator(".play-curve-canvas").click({ position: { x: 40, y: 12 } }); // leaves the editor
    await page.keyboard.press("Space");
    await until(() => window.lit.length >= 25);
    const lit = await page.evaluate(() => window.lit);
    const late = lit.map((each) => each.late).sort((a, b) => a - b);
    const frames = (await page.evaluate(() => window.frames_taken)).slice(-300).sort((a, b) => a - b);
    const slow = frames[Math.floor(frames.length * 0.95)];
    console.log(
        `${lit.length} notes lit, ${late[0].toFixed(1)} to ${late.at(-1).toFixed(1)} ms after they sound, half of them within `
            + `${late[late.length >> 1].toFixed(1)} ms; 95 % of the frames took less than ${slow.toFixed(1)} ms`,
    );
    for (const { line } of lit) assert.ok(line === 10 || line === 11, `line ${line}`);
    // A machine that is busy with other work does not reach 60 frames per second.
    assert.ok(late[Math.floor(late.length * 0.9)] < Math.max(20, 1.5 * slow));

    const before = await text(".play-place");
    await write(patternText("melodies/hilbert-in-c").replace("scale: major", "scale: dorian"));
    await until(() => /Dorian/.test(document.querySelector(".play-facts").textContent));
    const bar = (place) => Number(/Bar (\d+)/.exec(place)[1]);
    assert.ok(bar(await text(".play-place")) - bar(before) <= 2, "an edit keeps the place");
    assert.equal(await page.getAttribute(".play-main", "aria-label"), "Pause");

    await page.click('[aria-label="Loop"]');
    await page.fill('[aria-label="Loop from bar"]', "2");
    await page.fill('[aria-label="Loop to bar"]', "2");
    await page.keyboard.press("Tab");
    await page.click('[aria-label="Stop and return to the beginning"]');
    await until(() => /^Bar 2 of 16, beat 1/.test(document.querySelector(".play-place").textContent));
    await page.fill('[aria-label="Tempo, quarter notes per minute"]', "300");
    await page.keyboard.press("Enter");
    await page.click(".play-main");
    for (let i = 0; i < 8; ++i) {
        await page.waitForTimeout(220);
        assert.match(await text(".play-place"), /^Bar 2 of 16/);
    }
    await page.click(".play-main");
    assert.equal(await page.getAttribute(".play-main", "aria-label"), "Play");

    await page.click("summary:has-text('MIDI out')");
    await page.click("button:has-text('Connect MIDI')");
    await page.selectOption("#play-midi-port", "1");
    await page.click('[aria-label="Loop"]');
    await page.click(".play-main");
    await page.waitForTimeout(1500);
    await page.click(".play-main");
    const sent = await page.evaluate(() => window.midi);
    const of = (test) => sent.filter(({ bytes }) => test(bytes[0]));
    const clocks = of((status) => status === 0xf8).map(({ time }) => time);
    const gaps = clocks.slice(1).map((time, i) => time - clocks[i]);
    console.log(
        `MIDI: ${of((status) => (status & 0xf0) === 0x90).length} notes, ${clocks.length} clocks, `
            + `${Math.min(...gaps).toFixed(2)} to ${Math.max(...gaps).toFixed(2)} ms apart (8.33)`,
    );
    assert.equal(of((status) => status === 0xfa || status === 0xfb).length, 1);
    assert.equal(of((status) => status === 0xfc).length, 1);
    assert.ok(of((status) => (status & 0xf0) === 0x90).length > 3);
    await page.selectOption("#play-midi-port", "");

    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("button:has-text('Save as MIDI')")]);
    assert.match(saved.suggestedFilename(), /\.mid$/);
    assert.equal(
        readFileSync(await saved.path())
            .subarray(0, 4)
            .toString(),
        "MThd",
    );
}

async function bench() {
    await page.click("#tab-bench");
    const count = (lines) => until((wanted) => document.querySelector(".bench-count").textContent === wanted, lines);
    const grid = async (notation, written) => {
        await page.fill("#bench-grid", notation);
        await page.keyboard.press("Enter");
        await until((wanted) => document.querySelector(".cm-content").textContent.includes(`// grid: ${wanted}`), written);
    };
    await count("7 lines");
    await grid("15x15", "15x15");
    await count("15 lines");
    const board = await page.locator(".bench-board").boundingBox();
    const [x, y] = [board.x + board.width / 2, board.y + board.height / 2];
    await page.mouse.click(x + 22, y);
    await count("14 lines");
    await page.locator(".bench-board").focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Space");
    assert.match(
        await text(".bench [aria-live='assertive']"),
        /^Gap between row 8 dot \d+ and row 8 dot \d+: turned back; 13 lines$/,
    );
    await page.click("button:has-text('Make a single line')");
    await count("1 line");
    await until(() =>
        /^One closed line around 225 dots/.test(document.querySelector(".bench-certificate").textContent),
    );
    console.log(await text(".bench-certificate"));
    await page.waitForTimeout(1200);
    await page.keyboard.press("Escape");
    await page.click("h3:has-text('Symmetry')");
    await page.keyboard.press("Control+z");
    await count("13 lines");
    await page.fill("#bench-grid", "1-2-2");
    await page.keyboard.press("Enter");
    await until(() => /alternate between odd and even/.test(document.querySelector(".bench-problem").textContent));
    await page.waitForTimeout(1200);

    // An interlaced grid: the third state, six sides, symmetries, one line, undo.
    await grid("7-4 idukku pulli", "7-4 idukku");
    assert.match(await text(".bench-grid-facts"), /^37 dots in 7 rows, interlaced/);
    await page.locator(".bench-board").focus();
    const states = () => text(".bench-states");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Space");
    assert.match(await states(), /^89 gaps crossed, 1 turned back\.$/);
    await page.keyboard.press("Space");
    assert.match(await states(), /^89 gaps crossed, 1 joined\.$/);
    await page.keyboard.press("Shift+Space");
    assert.match(await states(), /^89 gaps crossed, 1 turned back\.$/);
    await page.keyboard.press("c");
    assert.match(await states(), /^90 gaps crossed\.$/);
    assert.equal(await page.locator("[aria-label='Symmetry'] .bench-lock:visible").count(), 10);
    await page.click('[aria-label="Sixth of a turn"]');
    await page.click("button:has-text('Join all')");
    assert.match(await states(), /^90 gaps joined\.$/);
    await page.click("button:has-text('Random kolam')");
    await until(() => / crossed/.test(document.querySelector(".bench-states").textContent));
    await until(() => /symmetry [CD]6\.$/.test(document.querySelector(".bench-certificate").textContent));
    await page.click("button:has-text('Make a single line')");
    await until(() => /^One closed line around \d+ dots; symmetry C6/.test(document.querySelector(".bench-certificate").textContent));
    console.log(await text(".bench-certificate"));

    // Free shapes: the dot in the middle goes away and comes back.
    await page.click(".bench-tool:has-text('Dots')");
    await page.mouse.click(x, y);
    await until(() => /^36 dots/.test(document.querySelector(".bench-grid-facts").textContent));
    await until(() => document.querySelector(".cm-content").textContent.includes("Kolam on 36 dots"));
    await page.mouse.click(x, y);
    await until(() => /^37 dots/.test(document.querySelector(".bench-grid-facts").textContent));
    await page.click(".bench-tool:has-text('Next')");

    // A shape drawn in text can be pasted.
    await page.evaluate(() => {
        const data = new DataTransfer();
        data.setData("text/plain", "oooo\no..o\noooo\n");
        const paste = new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true });
        document.querySelector("#bench-grid").dispatchEvent(paste);
    });
    await until(() => /^10 dots in 3 rows, straight/.test(document.querySelector(".bench-grid-facts").textContent));

    await grid("7 to 1 ner pulli", "1-3-5-7-5-3-1");
    await page.click('[aria-label="Quarter turns and mirrors"]');
    await until(() => /symmetry D4/.test(document.querySelector(".bench-certificate").textContent));
    await page.click("button:has-text('Make a single line')");
    await until(() => document.querySelector("#message").textContent.length > 0);
    console.log(`${await text(".bench-count")}: ${await text("#message")}`);
}

const benchText = () => page.evaluate(() => document.querySelector(".cm-content").cmTile?.view.state.doc.toString()
    ?? [...document.querySelectorAll(".cm-line")].map((line) => line.textContent).join("\n"));
const untilText = (part) => until((wanted) => document.querySelector(".cm-content").textContent.includes(wanted), part);

// Rims, words, grounds and the hand: all of them become the text, and can be undone.
async function looks() {
    await page.fill("#bench-grid", "9 to 1 ner pulli");
    await page.keyboard.press("Enter");
    await untilText("// grid: 1-3-5-7-9-7-5-3-1");
    await page.click("button:has-text('Cross all')");
    await page.waitForTimeout(1200);
    await page.click('[aria-label="Horns"]');
    await untilText("// rim: horn");
    const rim = () => text(".bench-rim[aria-checked='true']").then(() => page.getAttribute(".bench-rim[aria-checked='true']", "aria-label"));
    await page.keyboard.press("ArrowRight");
    await untilText("// rim: crescent");
    assert.equal(await rim(), "Crescents");
    await page.keyboard.press("ArrowLeft");
    await untilText("// rim: horn");
    await page.waitForTimeout(1200);
    await page.keyboard.press("Control+z");
    await until(() => !document.querySelector(".cm-content").textContent.includes("// rim:"));
    assert.equal(await rim(), "Round");

    await page.check("label:has-text('Dots between four crossings') input");
    await untilText("// centred dots: yes");
    await page.fill("#bench-grid", "9x9");
    await page.keyboard.press("Enter");
    await untilText("// grid: 9x9");
    await untilText("// centred dots: yes");
    await page.uncheck("label:has-text('Dots between four crossings') input");
    await until(() => !document.querySelector(".cm-content").textContent.includes("centred"));

    await page.click('[aria-label="Slate"]');
    await untilText("ground: slate");
    await page.click('[aria-label="White paper"]');
    await untilText("paper: white");
    assert.ok(!(await benchText()).includes("slate"));
    await page.waitForTimeout(1200);
    await page.focus("#bench-hand");
    for (let i = 0; i < 30; ++i) await page.keyboard.press("ArrowRight");
    await untilText("hand: 0.3");
    await page.waitForTimeout(1200);
    await page.click('[aria-label="Plain earth"]');
    await until(() => !document.querySelector(".cm-content").textContent.includes("paper: white"));
    await page.keyboard.press("Control+z");
    await untilText("paper: white");
    await page.click('[aria-label="Plain earth"]');
    await page.waitForTimeout(1200);

    await page.fill("#bench-word", "OM");
    await page.keyboard.press("Enter");
    await untilText("// letters: 12 OM");
    await untilText("title: OM");
    await page.fill("#bench-word-rows", "9");
    await page.keyboard.press("Enter");
    await untilText("// letters: 9 OM");
    const before = await text(".bench-states");
    await page.waitForTimeout(1200);
    await page.locator(".bench-board").focus();
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("t");
    await until((was) => document.querySelector(".bench-states").textContent !== was, before);
    await untilText("// letters: 9 OM");
    await page.waitForTimeout(1200);
    await page.fill("#bench-word", "MEERA MEERA MEERA");
    await page.fill("#bench-word-rows", "40");
    await page.keyboard.press("Enter");
    await until(() => /up to 1000 gaps/.test(document.querySelector(".bench-problem").textContent));
}

// The board itself is the photograph.
async function photograph() {
    await page.fill("#bench-grid", "5x5");
    await page.keyboard.press("Enter");
    await untilText("// grid: 5x5");
    await page.click("button:has-text('Random kolam')");
    await page.waitForTimeout(1500);
    const gaps = /gaps:([\d ]+)/.exec(await benchText())[1].replaceAll(" ", "");
    const picture = await page.evaluate(() => document.querySelector(".bench-board").toDataURL("image/png"));
    const buffer = Buffer.from(picture.slice(picture.indexOf(",") + 1), "base64");
    await page.setInputFiles("#bench-photograph", { name: "doorstep.png", mimeType: "image/png", buffer });
    await page.waitForSelector(".bench-view >> visible=true", { timeout: 60000 });
    await untilText("read from doorstep.png");
    assert.equal(/gaps:([\d ]+)/.exec(await benchText())[1].replaceAll(" ", ""), gaps);
    await page.click(".bench-view:has-text('Kolam')");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await page.getAttribute(".bench-view:has-text('Both')", "aria-checked"), "true");
    console.log(await text("#message"));

    // It leaves the board when a grid is chosen, and another kolam on 5x5 does not bring it back, but undo does.
    for (const grid of ["7x7", "5x5"]) {
        await page.waitForTimeout(1200);
        await page.fill("#bench-grid", grid);
        await page.keyboard.press("Enter");
        await untilText(`// grid: ${grid}`);
        await page.waitForSelector(".bench-view", { state: "hidden" });
    }
    await until(() => !document.querySelector(".cm-content").textContent.includes("read from doorstep.png"));
    for (let i = 0; i < 2; ++i) await page.getByRole("button", { name: /^Undo/ }).click();
    await page.waitForSelector(".bench-view >> visible=true");
    await untilText("read from doorstep.png");

    await page.setInputFiles("#bench-photograph", { name: "no.png", mimeType: "image/png", buffer: Buffer.from("no picture") });
    await until(() => /^no\.png: This browser cannot decode it/.test(document.querySelector("#message").textContent));

    // A pattern that the program has read marks its doubtful gaps.
    await write(`${await benchText()}\n// doubtful gaps, as row,gap:\n// 1,1 2,3\n`);
    await until(() => /^2 gaps .* are doubtful/.test(document.querySelector(".bench-doubts").textContent));
    await page.locator(".bench-board").focus();
    await page.keyboard.press("n");
    await page.keyboard.press("r");
    await until(() => /^1 gap .* is doubtful/.test(document.querySelector(".bench-doubts").textContent));
    await until(() => document.querySelector(".cm-content").textContent.match(/row,gap:[^a-z]*/)[0].match(/\d,\d/g).length === 1);
    await page.click("button:has-text('All are right')");
    await until(() => !document.querySelector(".cm-content").textContent.includes("doubtful"));
    assert.equal(await page.locator("button:has-text('All are right')").isVisible(), false);
}

try {
    await page.goto(addressOf(process.argv[2]));
    await page.waitForSelector("#tab-play");
    await play();
    await bench();
    await looks();
    await photograph();
    assert.deepEqual(errors, []);
} finally {
    await browser.close();
}
