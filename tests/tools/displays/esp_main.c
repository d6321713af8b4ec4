/* What an application of ESP-IDF has around esp_lcd.c. */
#include <esp_lcd_panel_ops.h>

void pinhole_task(esp_lcd_panel_handle_t panel);
void wait_until_sent(void);

void wait_until_sent(void)
{
}

int main(void)
{
    pinhole_task(NULL);
    return 1;
}
