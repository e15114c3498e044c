// What the page carries, compressed: the libraries, the worker and the script itself.

/// The bytes of an element of the page.
export async function unpack(id: string): Promise<ArrayBuffer> {
    const text = atob(document.getElementById(id)!.textContent!.trim());
    const bytes = new Uint8Array(text.length);
    for (let index = 0; index < text.length; ++index) bytes[index] = text.charCodeAt(index);
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).arrayBuffer();
}

/// An address of a script of the page.
export async function scriptAddress(id: string): Promise<string> {
    return URL.createObjectURL(new Blob([await unpack(id)], { type: "text/javascript" }));
}
