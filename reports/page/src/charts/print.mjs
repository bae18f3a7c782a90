import config from "../../../charts/config.json" with { type: "json" };

const CSS_PIXELS_PER_CENTIMETER = 96 / 2.54;

/** How wide every figure is in print, in CSS pixels: a column of a journal. */
export const PRINT_WIDTH = Math.floor(config.figureCentimeters * CSS_PIXELS_PER_CENTIMETER);
