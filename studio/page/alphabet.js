const excluded = "\0\t\n\v\f\r\x1a\x1b <\x7f"; // HTML or a terminal would take these for something else

/// The 117 characters of embedded data: seven of them hold six bytes.
export const alphabet = Array.from({ length: 128 }, (_, code) => String.fromCharCode(code))
    .filter((character) => !excluded.includes(character))
    .join("");
