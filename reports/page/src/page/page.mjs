import { append, element } from "./dom.mjs";
import { embeddedReport } from "./embedded.mjs";

const report = embeddedReport();
const page = document.getElementById("page");
if (report === null) append(page, element("p", {}, "This is the page of a report before ccdt report has put one in."));
else append(page, element("h1", {}, report.title));
