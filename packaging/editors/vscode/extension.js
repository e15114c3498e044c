// Starts `sikku lsp` for patterns.
const { window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

exports.activate = async () => {
    const command = workspace.getConfiguration("sikku").get("program", "sikku");
    const server = { command, args: ["lsp"] };
    client = new LanguageClient("sikku", "Sikku", server, {
        documentSelector: [{ language: "sikku" }],
    });
    try {
        await client.start();
    } catch (error) {
        client = undefined;
        window.showErrorMessage(
            `Cannot start '${command}': ${error.message}. Install it, or set 'sikku.program' to its path.`,
        );
    }
};

exports.deactivate = () => client?.stop();
