import { LANGUAGES, type Language, language, t } from "../text";
import { Dialog, Segments } from "../ui";
import { chooseLanguage, chooseTheme, THEMES, theme } from "./settings";

export function SettingsDialog({ open, onClose }: { open: boolean; onClose: () => void }) {
  const names = { auto: t("app.themeAuto"), light: t("app.themeLight"), dark: t("app.themeDark") };
  return (
    <Dialog title={t("app.settings")} open={open} onClose={onClose}>
      <div class="app-settings">
        <Segments
          label={t("app.theme")}
          value={theme.value}
          choices={THEMES.map((value) => ({ value, label: names[value] }))}
          onChange={chooseTheme}
        />
        <Segments
          label={t("app.language")}
          value={language.value}
          choices={Object.entries(LANGUAGES).map(([value, label]) => ({ value: value as Language, label }))}
          onChange={(chosen) => void chooseLanguage(chosen)}
        />
      </div>
    </Dialog>
  );
}
