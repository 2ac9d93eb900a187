// What the page uses of two writers of films.
export { ArrayBufferTarget, Muxer } from "webm-muxer";
export { applyPalette, GIFEncoder, quantize } from "gifenc";
