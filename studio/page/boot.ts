// The only script that is not compressed in the page: it unpacks the others.
import { scriptAddress } from "./embedded";

scriptAddress("sikku-script").then(
    (address) => {
        const script = document.createElement("script");
        script.src = address;
        document.body.append(script);
    },
    (error: unknown) => {
        document.getElementById("message")!.textContent = `The studio could not start: ${String(error)}`;
    },
);
