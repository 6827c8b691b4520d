// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0

export type Theme = "light" | "dark";

/** What surrounds the city. */
const backgrounds: Record<Theme, string> = { light: "#e4e8eb", dark: "#101418" };

/** Light or dark: what the system prefers until the user switches, or a link says. */
export class ThemeSwitch {
  private readonly preference = matchMedia("(prefers-color-scheme: dark)");
  private chosen: Theme | null = null;

  constructor(private readonly button: HTMLButtonElement, private readonly onChange: (background: string) => void) {
    this.preference.addEventListener("change", () => this.apply());
    button.addEventListener("click", () => this.choose(this.theme === "dark" ? "light" : "dark"));
  }

  get theme(): Theme {
    return this.chosen ?? (this.preference.matches ? "dark" : "light");
  }

  /** What was chosen, if anything was: links hold no more than that. */
  get choice(): Theme | null {
    return this.chosen;
  }

  choose(theme: Theme | null): void {
    this.chosen = theme;
    this.apply();
  }

  apply(): void {
    document.documentElement.dataset["theme"] = this.theme;
    this.button.setAttribute("aria-pressed", String(this.theme === "dark"));
    this.onChange(backgrounds[this.theme]);
  }
}
