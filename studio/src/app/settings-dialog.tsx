import { LANGUAGES, type Language, language, t } from "../text";
import { Button, Dialog, Segments } from "../ui";
import { chooseLanguage, chooseTheme, THEMES, theme } from "./settings";

interface SettingsProps {
  onClose: () => void;
  onHelp: () => void;
}

export function SettingsDialog({ onClose, onHelp }: SettingsProps) {
  const names = { auto: t("app.themeAuto"), light: t("app.themeLight"), dark: t("app.themeDark") };
  return (
    <Dialog title={t("app.settings")} open onClose={onClose}>
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
        <div>
          <Button icon="help" onClick={onHelp}>
            {t("app.help")}
          </Button>
        </div>
      </div>
    </Dialog>
  );
}
