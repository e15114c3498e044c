// The only script that is not compressed in the page: it unpacks the others.
import { scriptAddress } from "./embedded";
import { troubleOf } from "./trouble";

function fail(error: unknown): void {
    const { sentence } = troubleOf(error);
    document.getElementById("message")!.textContent = document.querySelector(".panels .empty")!.textContent = sentence;
}

scriptAddress("sikku-script").then(
    (address) => {
        const script = document.createElement("script");
        script.src = address;
        script.onerror = () => fail(new Error("the browser does not run the page's script"));
        document.body.append(script);
    },
    fail,
);
