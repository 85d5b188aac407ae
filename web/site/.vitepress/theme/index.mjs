// The default theme without its web fonts: the site uses the fonts of the reader's system.
export { default } from "vitepress/theme-without-fonts";
