// A client of `sikku lsp` for tests: requests, and the notifications that arrive meanwhile.
import {spawn} from "node:child_process";
import {pathToFileURL} from "node:url";

export class LanguageClient {
  #child;
  #bytes = Buffer.alloc(0);
  #answers = new Map();
  #last = 0;
  #listeners = [];

  constructor(program) {
    this.#child = spawn(program, ["lsp"], {stdio: ["pipe", "pipe", "inherit"]});
    this.#child.stdout.on("data", bytes => this.#read(bytes));
    this.ended = new Promise(resolve => this.#child.on("exit", status => resolve(status)));
  }

  #read(bytes) {
    this.#bytes = Buffer.concat([this.#bytes, bytes]);
    for (;;) {
      const end = this.#bytes.indexOf("\r\n\r\n");
      if (end < 0) return;
      const begin = end + 4, size = Number(/Content-Length: (\d+)/.exec(this.#bytes.subarray(0, end))[1]);
      if (this.#bytes.length < begin + size) return;
      const message = JSON.parse(this.#bytes.subarray(begin, begin + size));
      this.#bytes = this.#bytes.subarray(begin + size);
      if (message.method) {
        this.#listeners = this.#listeners.filter(wants => !wants(message));
      } else {
        this.#answers.get(message.id)(message);
        this.#answers.delete(message.id);
      }
    }
  }

  #send(message) {
    const bytes = Buffer.from(JSON.stringify({jsonrpc: "2.0", ...message}));
    this.#child.stdin.write(`Content-Length: ${bytes.length}\r\n\r\n`);
    this.#child.stdin.write(bytes);
  }

  request(method, params) {
    const id = ++this.#last;
    this.#send({id, method, params});
    return new Promise((resolve, reject) => this.#answers.set(id, answer => {
      if (answer.error) reject(new Error(`${method}: ${answer.error.message}`)); else resolve(answer.result);
    }));
  }

  notify(method, params) {
    this.#send({method, params});
  }

  /// The next errors of a document.
  diagnostics(uri) {
    return new Promise(resolve => this.#listeners.push(({method, params}) => {
      const found = method === "textDocument/publishDiagnostics" && params.uri === uri;
      if (found) resolve(params.diagnostics);
      return found;
    }));
  }

  async start() {
    const answer = await this.request("initialize", {processId: process.pid, rootUri: null, capabilities: {}});
    this.notify("initialized", {});
    return answer;
  }

  open(file, text) {
    const uri = pathToFileURL(file).href;
    this.notify("textDocument/didOpen", {textDocument: {uri, languageId: "sikku", version: 1, text}});
    return uri;
  }

  change(uri, text, version = 2) {
    this.notify("textDocument/didChange", {textDocument: {uri, version}, contentChanges: [{text}]});
  }

  close(uri) {
    this.notify("textDocument/didClose", {textDocument: {uri}});
  }

  async stop() {
    await this.request("shutdown");
    this.notify("exit");
    return this.ended;
  }
}
