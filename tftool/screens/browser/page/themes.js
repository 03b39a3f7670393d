// @ts-check
// The colours of the picture; those of the panels are in page.css.

export const THEMES = {
  dark: {
    background: "#14171d",
    grid: ["#2f3743", "#222832"],
    text: "#e8edf4",
    halo: "rgba(20, 23, 29, 0.85)",
    accent: "#ffb84d",
  },
  light: {
    background: "#f4f6fa",
    grid: ["#c3cbd7", "#dfe4ec"],
    text: "#1b2430",
    halo: "rgba(244, 246, 250, 0.9)",
    accent: "#a35f00",
  },
};
